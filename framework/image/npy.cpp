#include "framework/image/npy.hpp"

#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"
#include "framework/base/input_file.hpp"

// numpy.lib.format, version 1.0: magic, version, little-endian u16 header length, a Python dictionary padded with
// spaces so that the data begins at a multiple of 64 bytes, then the data.

namespace lightloom::image {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they lie in memory");

constexpr std::string_view kMagic{"\x93NUMPY\x01\x00", 8};
constexpr size_t kPreamble = kMagic.size() + 2;
constexpr size_t kAlignment = 64;

std::string_view dtype(ChannelType type) {
  switch (type) {
    case ChannelType::unorm8:
      return "|u1";
    case ChannelType::unorm16:
      return "<u2";
    case ChannelType::half:
      return "<f2";
    case ChannelType::float32:
      return "<f4";
    case ChannelType::uint32:
      return "<u4";
  }
  throw std::logic_error("unknown channel type");
}

std::optional<Format> find_format(std::string_view type, uint64_t channels) {
  for (const Format format : {Format::r8_unorm, Format::rgba8_unorm, Format::rgba16_unorm, Format::r16_sfloat,
                              Format::rg16_sfloat, Format::rgba16_sfloat, Format::r32_sfloat, Format::rg32_sfloat,
                              Format::rgba32_sfloat, Format::r32_uint, Format::rg32_uint, Format::rgba32_uint}) {
    if (dtype(channel_type(format)) == type && format_info(format).channels == channels) return format;
  }
  return std::nullopt;
}

std::string header(const ImageDesc& desc) {
  std::string shape = "(";
  if (desc.dimension == Dimension::d3) shape += std::to_string(desc.extent.depth) + ", ";
  shape += std::to_string(desc.extent.height) + ", " + std::to_string(desc.extent.width) + ", " +
           std::to_string(format_info(desc.format).channels) + ")";
  std::string text = "{'descr': '" + std::string(dtype(channel_type(desc.format))) +
                     "', 'fortran_order': False, 'shape': " + shape + ", }";
  const size_t unpadded = kPreamble + text.size() + 1;
  text.append((kAlignment - unpadded % kAlignment) % kAlignment, ' ');
  return text + '\n';
}

/// Text after `key` in the header dictionary, blanks skipped; empty if the key is missing.
std::string_view value_of(std::string_view text, std::string_view key) {
  const size_t at = text.find(key);
  if (at == std::string_view::npos) return {};
  text.remove_prefix(at + key.size());
  const size_t begin = text.find_first_not_of(": ");
  return begin == std::string_view::npos ? std::string_view{} : text.substr(begin);
}

std::vector<uint64_t> parse_shape(std::string_view text) {
  std::vector<uint64_t> shape;
  if (!text.starts_with('(')) return shape;
  text = text.substr(1, text.find(')') - 1);
  while (!text.empty()) {
    if (text.front() == ' ' || text.front() == ',') {
      text.remove_prefix(1);
      continue;
    }
    uint64_t size = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (error != std::errc{}) return {};
    shape.push_back(size);
    text.remove_prefix(static_cast<size_t>(end - text.data()));
  }
  return shape;
}

/// Shape and dtype of the header as an image description, or nothing where an image cannot have them.
std::optional<ImageDesc> parse_header(std::string_view text) {
  constexpr uint64_t kMaxSide = 1u << 16;
  const std::string_view type = value_of(text, "'descr'");
  const std::vector<uint64_t> shape = parse_shape(value_of(text, "'shape'"));
  if (type.size() < 5 || type[0] != '\'' || type[4] != '\'' || !value_of(text, "'fortran_order'").starts_with("False"))
    return std::nullopt;
  if (shape.size() != 3 && shape.size() != 4) return std::nullopt;
  const std::optional<Format> format = find_format(type.substr(1, 3), shape.back());
  for (const uint64_t side : shape) {
    if (side == 0 || side > kMaxSide) return std::nullopt;
  }
  if (!format) return std::nullopt;
  const bool volume = shape.size() == 4;
  const size_t rows = volume ? 1 : 0;
  return ImageDesc{*format,
                   volume ? Dimension::d3 : Dimension::d2,
                   {static_cast<uint32_t>(shape[rows + 1]), static_cast<uint32_t>(shape[rows]),
                    volume ? static_cast<uint32_t>(shape[0]) : 1u}};
}

}  // namespace

void write_npy(const std::filesystem::path& file, const HostImage& image) {
  if (image.texels.size() != byte_size(image.desc)) {
    throw Error(ExitCode::run_failed,
                "cannot write '" + file.string() + "': the image does not hold " + to_string(image.desc));
  }
  const std::string text = header(image.desc);
  std::string bytes(kMagic);
  bytes += static_cast<char>(text.size() & 0xFF);
  bytes += static_cast<char>(text.size() >> 8);
  bytes += text;
  const size_t data = bytes.size();
  bytes.resize(data + image.texels.size());
  if (!image.texels.empty()) std::memcpy(bytes.data() + data, image.texels.data(), image.texels.size());
  write_file_atomically(file, bytes);
}

HostImage read_npy(const std::filesystem::path& file, const Limits* limits) {
  const auto fail = [&file](const std::string& cause) {
    throw Error(ExitCode::invalid_input, "cannot read '" + file.string() + "' as .npy: " + cause);
  };
  InputFile source(file);
  if (!source.problem().empty()) fail("the file " + source.problem());
  std::string begin(kPreamble, '\0');
  if (!source.read(begin.data(), begin.size()) || !begin.starts_with(kMagic))
    fail("it does not begin as a version 1.0 array");
  const size_t header_size =
      static_cast<uint8_t>(begin[8]) + (static_cast<size_t>(static_cast<uint8_t>(begin[9])) << 8);
  std::string text(header_size, '\0');
  if (!source.read(text.data(), text.size())) fail("it ends within its header");
  const std::optional<ImageDesc> desc = parse_header(text);
  if (!desc) fail("its header does not describe an image or volume of a known texel format");
  const uint64_t data = source.size() - kPreamble - header_size;
  if (data != byte_size(*desc)) {
    fail("it has " + std::to_string(data) + " bytes of data where its shape needs " + std::to_string(byte_size(*desc)));
  }
  const Extent3& extent = desc->extent;
  if (limits != nullptr) {
    require_within(*limits, &Limits::float_texels, "'" + file.string() + "'",
                   uint64_t{extent.width} * extent.height * extent.depth);
  }
  HostImage image{*desc, std::vector<std::byte>(data)};
  if (!source.read(image.texels.data(), data)) fail("it cannot be read");
  return image;
}

}  // namespace lightloom::image
