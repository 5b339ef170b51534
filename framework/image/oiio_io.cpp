#include "framework/image/oiio_io.hpp"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <span>
#include <system_error>
#include <vector>

#include "framework/base/atomic_file.hpp"
#include "framework/base/error.hpp"

namespace lightloom::image {
namespace {

[[noreturn]] void fail_to_read(const std::filesystem::path& file, const std::string& format, const std::string& cause) {
  throw Error(ExitCode::invalid_input, "cannot read '" + file.string() + "' as " + format + ": " + cause);
}

void require_file(const std::filesystem::path& file, const std::string& format) {
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) fail_to_read(file, format, "there is no such file");
  if (!std::filesystem::is_regular_file(file, ignored)) fail_to_read(file, format, "it is not a regular file");
}

void require_flat(const std::filesystem::path& file, const std::string& format, const OIIO::ImageSpec& spec) {
  if (spec.deep || spec.depth > 1 || spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) {
    fail_to_read(file, format, "only flat 2D images are supported");
  }
}

/// OpenImageIO's messages may have several lines.
std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

}  // namespace

void encode_and_write(const std::filesystem::path& file, const std::string& format, const OIIO::ImageSpec& spec,
                      const void* samples) {
  const auto fail = [&file](const std::string& cause) {
    throw Error(ExitCode::run_failed, "cannot encode '" + file.string() + "': " + cause);
  };
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) fail("this OpenImageIO was built without " + format);
  std::vector<unsigned char> encoded;
  OIIO::Filesystem::IOVecOutput memory(encoded);
  if (!output->set_ioproxy(&memory) || !output->open(file.string(), spec)) fail(output->geterror());
  if (!output->write_image(spec.format, samples) || !output->close()) fail(output->geterror());
  write_file_atomically(file, std::as_bytes(std::span<const unsigned char>(encoded)));
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file, const std::string& format,
                                             const OIIO::ImageSpec& config) {
  require_file(file, format);
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input) fail_to_read(file, format, "this OpenImageIO was built without it");
  OIIO::ImageSpec spec;
  if (!input->open(file.string(), spec, config)) fail_to_read(file, format, input->geterror());
  require_flat(file, format, spec);
  return input;
}

std::unique_ptr<OIIO::ImageInput> open_image(const std::filesystem::path& file, const OIIO::ImageSpec& config) {
  const std::string kind = "an image";
  require_file(file, kind);
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.string(), &config);
  if (!input) fail_to_read(file, kind, one_line(OIIO::geterror()));
  require_flat(file, kind, input->spec());
  return input;
}

void read_samples(OIIO::ImageInput& input, const std::filesystem::path& file, const OIIO::TypeDesc& type,
                  void* samples) {
  if (!input.read_image(0, 0, 0, input.spec().nchannels, type, samples)) {
    fail_to_read(file, input.format_name(), input.geterror());
  }
}

void require_complete(const HostImage& image, const std::filesystem::path& file) {
  if (image.texels.size() == byte_size(image.desc)) return;
  throw Error(ExitCode::run_failed, "cannot write '" + file.string() + "': the image holds " +
                                        std::to_string(image.texels.size()) + " bytes where " + to_string(image.desc) +
                                        " needs " + std::to_string(byte_size(image.desc)));
}

}  // namespace lightloom::image
