// Pictures: the headers of PNG, JPEG, Radiance HDR, OpenEXR and NumPy files by our own reader, and whatever it lets
// through by the decoders behind it, as a texture, as an environment and as `compare` reads it.
#include <cstdlib>
#include <string_view>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/image_header.hpp"
#include "framework/image/read_image.hpp"
#include "framework/scene/images.hpp"
#include "tests/fuzz/private_folder.hpp"

namespace {

using namespace lightloom;

template <typename Read>
void attempt(Read read) {
  try {
    read();
  } catch (const Error& error) {
    if (error.code() != ExitCode::invalid_input) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const fuzz::PrivateFolder folder;
  const std::span<const uint8_t> bytes(data, size);
  std::string problem;
  const auto header = read_image_header(bytes, problem);
  if (header.has_value() != problem.empty()) std::abort();
  scene::LoadOptions options;
  Limits& limits = options.limits;
  limits.image_texels = limits.float_texels = 1 << 16;
  limits.image_side = 4096;
  limits.jpeg_scans = 12;
  const std::vector<uint8_t> copy(bytes.begin(), bytes.end());
  attempt([&] { static_cast<void>(scene::decode_image(copy, "fuzz", "image", limits)); });
  if (std::string_view(reinterpret_cast<const char*>(data), size).starts_with("\x93NUMPY")) {
    const std::filesystem::path file = folder.write("a.npy", bytes);
    attempt([&] { static_cast<void>(image::read_image(file, {.channel = {}, .linear = false, .limits = limits})); });
  } else if (header) {
    const std::filesystem::path file = folder.write("a.image", bytes);
    scene::Environment environment;
    attempt([&] { scene::load_environment(file, "fuzz", environment, options); });
    attempt([&] { static_cast<void>(image::read_image(file, {.channel = {}, .linear = false, .limits = limits})); });
  }
  return 0;
}
