#include "framework/scene/gltf_uri.hpp"

#include <string_view>

#include "framework/scene/fail.hpp"
#include "framework/scene/input_context.hpp"

namespace lightloom::scene {
namespace {

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::vector<uint8_t> decode_base64(std::string_view text, const std::string& file, const std::string& element) {
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::vector<uint8_t> bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  uint32_t bits = 0, count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) fail(file, element, "holds a character that is not base64, expected A-Z, a-z, 0-9, + and /");
    bits = bits << 6 | static_cast<uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<uint8_t>(bits >> count & 0xFFu));
  }
  return bytes;
}

std::vector<uint8_t> decode_data_uri(const std::string& uri, const std::string& file, const std::string& element) {
  const size_t comma = uri.find(',');
  const std::string_view header = std::string_view(uri).substr(0, comma);
  if (comma == std::string::npos || header.find(";;") != std::string_view::npos) {
    fail(file, element, "is a data URI without base64 content, expected data:TYPE;base64,CONTENT");
  }
  if (!header.ends_with(";base64")) {  // RFC 2397: then the content is percent-encoded
    const std::string content = percent_decode(uri.substr(comma + 1));
    return {content.begin(), content.end()};
  }
  return decode_base64(std::string_view(uri).substr(comma + 1), file, element);
}

}  // namespace

bool is_data_uri(const std::string& uri) {
  return uri.starts_with("data:");
}

std::vector<uint8_t> read_uri(const GltfFile& file, const std::string& uri, const std::string& element,
                              std::optional<uint64_t> count) {
  const std::string wanted_by = file.name + ": " + element;
  if (is_data_uri(uri)) {
    file.context->spend_bytes(uri.size() / 4 * 3, wanted_by);
    return decode_data_uri(uri, file.name, element);
  }
  return file.context->read(file.context->resolve(file.path.parent_path(), uri, wanted_by), wanted_by, count);
}

}  // namespace lightloom::scene
