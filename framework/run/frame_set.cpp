#include "framework/run/frame_set.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <system_error>

#include "framework/base/text.hpp"

namespace lightloom::run {
namespace {

constexpr uint32_t kNoEnd = std::numeric_limits<uint32_t>::max();

std::optional<uint32_t> number(std::string_view text) {
  uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<FrameSpan> parse_span(std::string_view text) {
  const size_t dots = text.find("..");
  const std::optional<uint32_t> first = number(text.substr(0, dots));
  if (!first) return std::nullopt;
  if (dots == std::string_view::npos) return FrameSpan{*first, *first, 1};
  std::string_view rest = text.substr(dots + 2);
  const size_t colon = rest.find(':');
  const std::optional<uint32_t> step = colon == std::string_view::npos ? 1 : number(rest.substr(colon + 1));
  rest = rest.substr(0, colon);
  const std::optional<uint32_t> last = rest.empty() ? kNoEnd : number(rest);
  if (!step || !last || *step == 0 || *last < *first) return std::nullopt;
  return FrameSpan{*first, *last, *step};
}

}  // namespace

bool FrameSet::contains(uint32_t frame) const {
  return meets(frame, frame);
}

bool FrameSet::meets(uint32_t first, uint32_t last) const {
  return spans.empty() || std::any_of(spans.begin(), spans.end(), [&](const FrameSpan& span) {
           if (last < span.first) return false;
           const uint64_t skipped =
               first <= span.first ? 0 : (uint64_t{first} - span.first + span.step - 1) / span.step;
           return span.first + skipped * span.step <= std::min(last, span.last);
         });
}

std::string parse_frame_set(std::string_view text, FrameSet& set) {
  FrameSet parsed;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view part = text.substr(begin, end - begin);
    const std::optional<FrameSpan> span = parse_span(part);
    if (!span)
      return "expected frames such as 0..3,10,20..100:10 (every tenth) or 0..:100 (every hundredth, without an end), "
             "got " +
             in_quotes(part);
    parsed.spans.push_back(*span);
    begin = end + 1;
  }
  set = std::move(parsed);
  return {};
}

std::string to_string(const FrameSet& set) {
  if (set.spans.empty()) return "all";
  std::string text;
  for (const FrameSpan& span : set.spans) {
    text += (text.empty() ? "" : ",") + std::to_string(span.first);
    if (span.first == span.last) continue;
    text += ".." + (span.last == kNoEnd ? "" : std::to_string(span.last));
    if (span.step != 1) text += ":" + std::to_string(span.step);
  }
  return text;
}

}  // namespace lightloom::run
