#include "framework/image/frame_files.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace lightloom::image {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDigits = "0123456789";
constexpr std::array<std::string_view, 9> kExtensions = {".exr",  ".npy", ".hdr", ".pfm", ".tif",
                                                         ".tiff", ".png", ".jpg", ".jpeg"};

/// What stands before and after the frame number in a file name.
struct NumberPlace {
  std::string before;
  std::string after;
  size_t digits = 1;  ///< at least
};

std::optional<NumberPlace> place_of_hashes(const std::string& name) {
  const size_t begin = name.find('#');
  if (begin == std::string::npos) return std::nullopt;
  const size_t end = std::min(name.find_first_not_of('#', begin), name.size());
  return NumberPlace{name.substr(0, begin), name.substr(end), end - begin};
}

/// %d, %4d or %04d.
std::optional<NumberPlace> place_of_percent(const std::string& name) {
  const size_t begin = name.find('%');
  if (begin == std::string::npos) return std::nullopt;
  const size_t end = name.find_first_not_of(kDigits, begin + 1);
  if (end == std::string::npos || name[end] != 'd' || end - begin > 3) return std::nullopt;
  NumberPlace place{name.substr(0, begin), name.substr(end + 1), 1};
  const std::string width = name.substr(begin + 1, end - begin - 1);
  if (!width.empty()) place.digits = std::max(1ul, std::stoul(width));
  return place;
}

std::optional<NumberPlace> number_place(const fs::path& pattern) {
  const std::string name = pattern.filename().string();
  if (const auto place = place_of_percent(name)) return place;
  return place_of_hashes(name);
}

/// Frame number of a file name that fits.
std::optional<uint32_t> frame_of(std::string_view name, const NumberPlace& place) {
  if (name.size() < place.before.size() + place.after.size() + place.digits || !name.starts_with(place.before) ||
      !name.ends_with(place.after))
    return std::nullopt;
  const std::string_view digits =
      name.substr(place.before.size(), name.size() - place.before.size() - place.after.size());
  uint32_t frame = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), frame);
  if (error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  // A number without zeros in front may be longer than its place, one with zeros may not.
  if (digits.size() > place.digits && digits[0] == '0') return std::nullopt;
  return frame;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    names.push_back(entry->path().filename().string());
  if (error)
    throw Error(ExitCode::invalid_input, "cannot read the folder '" + folder.string() + "': " + error.message());
  std::sort(names.begin(), names.end());
  return names;
}

std::map<uint32_t, fs::path> frames_that_fit(const fs::path& folder, const std::vector<std::string>& names,
                                             const NumberPlace& place) {
  std::map<uint32_t, fs::path> frames;
  for (const std::string& name : names)
    if (const auto frame = frame_of(name, place)) frames[*frame] = folder / name;
  return frames;
}

/// OUTPUT of names OUTPUT.FFFF.EXT.
std::vector<std::string> outputs_among(const std::vector<std::string>& names) {
  std::set<std::string> outputs;
  for (const std::string& name : names) {
    const fs::path path = name;
    const std::string extension = path.extension().string(), digits = path.stem().extension().string();
    const bool numbered = digits.size() > 4 && digits.find_first_not_of(kDigits, 1) == std::string::npos;
    if (numbered && std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end())
      outputs.insert(path.stem().stem().string());
  }
  return {outputs.begin(), outputs.end()};
}

FrameFiles frames_of_folder(const fs::path& folder, const std::string& output) {
  const std::vector<std::string> names = names_in(folder);
  for (const std::string_view extension : kExtensions) {
    const NumberPlace place{output + ".", std::string(extension), 4};
    if (auto frames = frames_that_fit(folder, names, place); !frames.empty()) return {std::move(frames), false};
  }
  const std::vector<std::string> outputs = outputs_among(names);
  throw Error(ExitCode::invalid_input,
              "the folder '" + folder.string() + "' has no frames of an output " + in_quotes(output) + " (" + output +
                  ".FFFF.exr)",
              outputs.empty() ? "" : "--output NAME chooses another; there are: " + join(outputs, ", "));
}

}  // namespace

bool has_frame_number(const fs::path& pattern) {
  return number_place(pattern).has_value();
}

fs::path with_frame_number(const fs::path& pattern, uint32_t frame) {
  const std::optional<NumberPlace> place = number_place(pattern);
  if (!place) return pattern;
  const std::string digits = std::to_string(frame);
  const std::string zeros(place->digits > digits.size() ? place->digits - digits.size() : 0, '0');
  return pattern.parent_path() / (place->before + zeros + digits + place->after);
}

FrameFiles find_frames(const fs::path& place, const std::string& output) {
  std::error_code ignored;
  if (fs::is_directory(place, ignored)) return frames_of_folder(place, output);
  const std::optional<NumberPlace> number = number_place(place);
  if (fs::exists(place, ignored) || !number) return {{{0, place}}, true};
  const fs::path folder = place.has_parent_path() ? place.parent_path() : fs::path(".");
  auto frames = frames_that_fit(folder, names_in(folder), *number);
  if (frames.empty()) throw Error(ExitCode::invalid_input, "no file fits the pattern '" + place.string() + "'");
  return {std::move(frames), false};
}

}  // namespace lightloom::image
