#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene::test {
namespace {

void append_u32(std::vector<uint8_t>& bytes, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<uint8_t>(value >> shift & 255u));
}

void append_chunk(std::vector<uint8_t>& png, const std::string& type, const std::vector<uint8_t>& data) {
  append_u32(png, static_cast<uint32_t>(data.size()));
  std::vector<uint8_t> body(type.begin(), type.end());
  body.insert(body.end(), data.begin(), data.end());
  uint32_t crc = 0xFFFFFFFFu;
  for (const uint8_t byte : body) {
    crc ^= byte;
    for (int k = 0; k < 8; ++k) crc = (crc & 1u) != 0 ? crc >> 1 ^ 0xEDB88320u : crc >> 1;
  }
  png.insert(png.end(), body.begin(), body.end());
  append_u32(png, ~crc);
}

}  // namespace

std::vector<uint8_t> make_png(uint32_t width, uint32_t height, int bit_depth, int color_type,
                              const std::vector<uint8_t>& rows) {
  std::vector<uint8_t> png = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  std::vector<uint8_t> header;
  append_u32(header, width);
  append_u32(header, height);
  for (const int value : {bit_depth, color_type, 0, 0, 0}) header.push_back(static_cast<uint8_t>(value));
  append_chunk(png, "IHDR", header);

  std::vector<uint8_t> filtered;
  const size_t stride = rows.size() / height;
  for (uint32_t y = 0; y < height; ++y) {
    filtered.push_back(0);
    filtered.insert(filtered.end(), rows.begin() + static_cast<std::ptrdiff_t>(y * stride),
                    rows.begin() + static_cast<std::ptrdiff_t>((y + 1) * stride));
  }
  const auto size = static_cast<uint16_t>(filtered.size());
  std::vector<uint8_t> zlib = {0x78,
                               0x01,
                               1,
                               static_cast<uint8_t>(size & 255u),
                               static_cast<uint8_t>(size >> 8),
                               static_cast<uint8_t>(~size & 255),
                               static_cast<uint8_t>((~size >> 8) & 255)};
  zlib.insert(zlib.end(), filtered.begin(), filtered.end());
  uint32_t a = 1, b = 0;
  for (const uint8_t byte : filtered) {
    a = (a + byte) % 65521u;
    b = (b + a) % 65521u;
  }
  append_u32(zlib, b << 16 | a);
  append_chunk(png, "IDAT", zlib);
  append_chunk(png, "IEND", {});
  return png;
}

}  // namespace lightloom::scene::test
