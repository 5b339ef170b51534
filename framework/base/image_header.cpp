#include "framework/base/image_header.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <initializer_list>
#include <string_view>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

/// Reads forward through bytes; past the end it gives zeros and remembers that.
class ByteReader {
 public:
  explicit ByteReader(std::span<const uint8_t> bytes, size_t offset = 0) : bytes_(bytes), offset_(offset) {}

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] size_t offset() const { return offset_; }
  [[nodiscard]] size_t left() const { return bytes_.size() - offset_; }

  uint8_t byte() {
    if (offset_ >= bytes_.size()) {
      failed_ = true;
      return 0;
    }
    return bytes_[offset_++];
  }
  uint32_t big_endian(size_t size) {
    uint32_t value = 0;
    for (size_t k = 0; k < size; ++k) value = value << 8 | byte();
    return value;
  }
  uint32_t little_endian() {
    uint32_t value = 0;
    for (uint32_t k = 0; k < 4; ++k) value |= uint32_t{byte()} << (8 * k);
    return value;
  }
  void skip(uint64_t count) {
    if (count > left()) {
      failed_ = true;
      offset_ = bytes_.size();
    } else {
      offset_ += static_cast<size_t>(count);
    }
  }
  /// Up to a zero, which is skipped.
  std::string_view text() {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(offset_);
    const auto end = std::find(begin, bytes_.end(), uint8_t{0});
    const std::string_view result(reinterpret_cast<const char*>(bytes_.data()) + offset_,
                                  static_cast<size_t>(end - begin));
    failed_ = failed_ || end == bytes_.end();
    offset_ = std::min(bytes_.size(), offset_ + result.size() + 1);
    return result;
  }

 private:
  std::span<const uint8_t> bytes_;
  size_t offset_ = 0;
  bool failed_ = false;
};

bool starts_with(std::span<const uint8_t> bytes, std::initializer_list<uint8_t> magic) {
  return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

// All chunks of a PNG must lie within the file: libpng would print about those that do not.
bool is_whole_png(std::span<const uint8_t> bytes) {
  constexpr uint32_t kEnd = 0x49454E44u;  // "IEND"
  ByteReader reader(bytes, 8);
  while (reader.left() >= 12) {
    const uint32_t length = reader.big_endian(4), type = reader.big_endian(4);
    if (uint64_t{length} + 4 > reader.left()) return false;
    if (type == kEnd) return true;
    reader.skip(uint64_t{length} + 4);
  }
  return false;
}

bool read_png(std::span<const uint8_t> bytes, ImageHeader& header, std::string& problem) {
  constexpr uint32_t kHeader = 0x49484452u;  // "IHDR"
  ByteReader reader(bytes, 8);
  const bool first = reader.big_endian(4) == 13 && reader.big_endian(4) == kHeader;
  header.width = reader.big_endian(4);
  header.height = reader.big_endian(4);
  reader.byte();
  const uint8_t color = reader.byte();
  if (!first || reader.failed()) {
    problem = "is a PNG file without the header chunk in the first place";
    return false;
  }
  constexpr std::array<uint64_t, 7> kChannels = {1, 0, 3, 4, 2, 0, 4};  // a palette may have transparent entries
  header.channels = color < kChannels.size() ? kChannels[color] : 0;
  header.whole = is_whole_png(bytes);
  return true;
}

bool is_frame_marker(uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

// Walks all markers: libjpeg fills what is missing of a cut file with grey and says nothing.
bool read_jpeg(std::span<const uint8_t> bytes, ImageHeader& header, std::string& problem) {
  size_t offset = 2;
  header.whole = false;
  while (offset + 2 <= bytes.size()) {
    const uint8_t marker = bytes[offset + 1];
    const bool in_scan = bytes[offset] != 0xFF || marker == 0x00 || marker == 0xFF;
    if (in_scan) {
      ++offset;
    } else if (marker == 0xD9) {
      header.whole = true;
      break;
    } else if (marker >= 0xD0 && marker <= 0xD8) {
      offset += 2;
    } else {
      ByteReader reader(bytes, offset + 2);
      const uint32_t length = reader.big_endian(2);
      if (reader.failed()) break;
      if (is_frame_marker(marker)) {
        reader.byte();
        header.height = reader.big_endian(2);
        header.width = reader.big_endian(2);
        header.channels = reader.byte();
      }
      header.scans += marker == 0xDA ? 1 : 0;
      offset += 2 + std::max(length, 2u);
    }
  }
  if (header.channels == 0) problem = "is a JPEG file without a frame header";
  return header.channels != 0;
}

/// "-Y 512 +X 1024" in any of its eight orders.
bool read_resolution(std::string_view line, ImageHeader& header) {
  for (int k = 0; k < 2; ++k) {
    while (line.starts_with(' ')) line.remove_prefix(1);
    if (line.size() < 4 || (line[0] != '-' && line[0] != '+') || (line[1] != 'X' && line[1] != 'Y')) return false;
    uint64_t& size = line[1] == 'X' ? header.width : header.height;
    line.remove_prefix(2);
    while (line.starts_with(' ')) line.remove_prefix(1);
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), size);
    if (error != std::errc{}) return false;
    line.remove_prefix(static_cast<size_t>(end - line.data()));
  }
  return header.width > 0 && header.height > 0;
}

bool read_hdr(std::span<const uint8_t> bytes, ImageHeader& header, std::string& problem) {
  constexpr size_t kLongestHeader = 65536;
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), std::min(bytes.size(), kLongestHeader));
  bool blank = false;
  header.channels = 3;
  while (!text.empty()) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) break;
    const std::string_view line = text.substr(0, end);
    if (blank && read_resolution(line, header)) return true;
    if (blank) break;
    blank = line.empty() || line == "\r";
    text.remove_prefix(end + 1);
  }
  problem = "is a Radiance file without a line that gives its resolution";
  return false;
}

/// Of one part of an OpenEXR file.
struct ExrPart {
  int64_t width = 0, height = 0;
  uint64_t channels = 0;
  uint64_t tile_width = 0, tile_height = 0;
};

/// Skips a list of channels; their number.
uint64_t count_channels(ByteReader& reader) {
  uint64_t channels = 0;
  while (!reader.failed() && !reader.text().empty()) {
    reader.skip(16);
    ++channels;
  }
  return channels;
}

/// An attribute's type whose values have one size [bytes].
struct ExrType {
  std::string_view name;
  uint32_t size;
};
constexpr std::array kExrTypes = {ExrType{"box2i", 16},      ExrType{"box2f", 16},   ExrType{"chromaticities", 32},
                                  ExrType{"compression", 1}, ExrType{"double", 8},   ExrType{"envmap", 1},
                                  ExrType{"float", 4},       ExrType{"int", 4},      ExrType{"keycode", 28},
                                  ExrType{"lineOrder", 1},   ExrType{"m33f", 36},    ExrType{"m33d", 72},
                                  ExrType{"m44f", 64},       ExrType{"m44d", 128},   ExrType{"rational", 8},
                                  ExrType{"tiledesc", 9},    ExrType{"timecode", 8}, ExrType{"v2i", 8},
                                  ExrType{"v2f", 8},         ExrType{"v2d", 16},     ExrType{"v3i", 12},
                                  ExrType{"v3f", 12},        ExrType{"v3d", 24},     ExrType{"deepImageState", 1}};

/// Does a value of this type take the `size` bytes that the file says? OpenEXR reads as many as the type has, whatever
/// the size, and what comes behind is then another attribute to it than to us.
bool fits_its_size(std::string_view type, uint32_t size, ByteReader value) {
  const size_t before = value.left();
  const auto fixed = std::find_if(kExrTypes.begin(), kExrTypes.end(), [&](const ExrType& t) { return t.name == type; });
  if (fixed != kExrTypes.end()) return size == fixed->size;
  if (type == "chlist") {
    static_cast<void>(count_channels(value));
    return !value.failed() && before - value.left() == size;
  }
  if (type == "preview") {
    const uint64_t width = value.little_endian(), height = value.little_endian();
    return multiply_saturated(multiply_saturated(width, height), 4) == uint64_t{size} - 8 && size >= 8;
  }
  if (type == "stringvector") {
    while (!value.failed() && before - value.left() < size) value.skip(value.little_endian());
    return !value.failed() && before - value.left() == size;
  }
  // Deflate makes data at most 1032 times smaller.
  if (type == "idmanifest") return size >= 4 && value.little_endian() <= uint64_t{size} * 1032;
  return true;
}

/// Attributes up to the empty name that ends them; false where they are broken.
bool read_exr_part(ByteReader& reader, ExrPart& part) {
  for (std::string_view name = reader.text(); !name.empty(); name = reader.text()) {
    const std::string_view type = reader.text();
    const uint32_t size = reader.little_endian();
    if (reader.failed() || size > reader.left() || !fits_its_size(type, size, reader)) return false;
    ByteReader value = reader;
    if (name == "dataWindow") {
      std::array<int32_t, 4> box{};
      for (int32_t& side : box) side = static_cast<int32_t>(value.little_endian());
      part.width = int64_t{box[2]} - box[0] + 1;
      part.height = int64_t{box[3]} - box[1] + 1;
    } else if (name == "channels") {
      part.channels = count_channels(value);
    } else if (name == "tiles") {
      part.tile_width = value.little_endian();
      part.tile_height = value.little_endian();
    }
    reader.skip(size);
  }
  return !reader.failed() && part.width > 0 && part.height > 0 && part.channels > 0;
}

bool read_exr(std::span<const uint8_t> bytes, ImageHeader& header, std::string& problem) {
  constexpr uint32_t kManyParts = 0x1000;
  ByteReader reader(bytes, 4);
  const uint32_t version = reader.little_endian();
  do {
    ExrPart part;
    if (!read_exr_part(reader, part)) {
      problem = "is an OpenEXR file with a broken header";
      return false;
    }
    const auto width = static_cast<uint64_t>(part.width), height = static_cast<uint64_t>(part.height);
    header.width = std::max(header.width, width);
    header.height = std::max(header.height, height);
    header.channels = std::max(header.channels, part.channels);
    const bool tiled = part.tile_width > 0 && part.tile_height > 0;
    header.chunks +=
        tiled ? multiply_saturated((width - 1) / part.tile_width + 1, (height - 1) / part.tile_height + 1) : height;
  } while ((version & kManyParts) != 0 && reader.left() > 0 && bytes[reader.offset()] != 0);
  return true;
}

}  // namespace

ImageFileFormat image_file_format(std::span<const uint8_t> bytes) {
  if (starts_with(bytes, {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'})) return ImageFileFormat::png;
  if (starts_with(bytes, {0xFF, 0xD8, 0xFF})) return ImageFileFormat::jpeg;
  if (starts_with(bytes, {'#', '?'})) return ImageFileFormat::hdr;
  if (starts_with(bytes, {0x76, 0x2F, 0x31, 0x01})) return ImageFileFormat::exr;
  return ImageFileFormat::unknown;
}

std::optional<ImageHeader> read_image_header(std::span<const uint8_t> bytes, std::string& problem) {
  ImageHeader header{.format = image_file_format(bytes)};
  bool read = false;
  switch (header.format) {
    case ImageFileFormat::png:
      read = read_png(bytes, header, problem);
      break;
    case ImageFileFormat::jpeg:
      read = read_jpeg(bytes, header, problem);
      break;
    case ImageFileFormat::hdr:
      read = read_hdr(bytes, header, problem);
      break;
    case ImageFileFormat::exr:
      read = read_exr(bytes, header, problem);
      break;
    case ImageFileFormat::unknown:
      problem = "is not a PNG, JPEG, Radiance HDR or OpenEXR file";
      break;
  }
  if (read && (header.width == 0 || header.height == 0 || header.channels == 0)) {
    problem = "has no texels";
    read = false;
  }
  return read ? std::optional(header) : std::nullopt;
}

void require_image_within(const ImageHeader& header, const Limits& limits, uint64_t Limits::*texels,
                          const std::string& element) {
  require_within(limits, &Limits::image_side, element + " (a side)", std::max(header.width, header.height));
  const uint64_t weight = (header.channels + 3) / 4;
  const uint64_t area = multiply_saturated(header.width, header.height);
  require_within(limits, texels, element, multiply_saturated(area, weight));
  require_within(limits, &Limits::jpeg_scans, element, header.scans);
  if (header.chunks > std::max<uint64_t>(area, 4096)) {
    throw Error(ExitCode::invalid_input, element + " has " + std::to_string(header.chunks) +
                                             " tiles or rows, more than its texels, expected larger tiles");
  }
}

}  // namespace lightloom
