#include "framework/scene/images.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <thread>

#include "framework/base/interrupt.hpp"
#include "framework/scene/fail.hpp"

namespace lightloom::scene {
namespace {

constexpr int64_t kMaxTexels = int64_t{1} << 26;

std::string format_of(const std::vector<uint8_t>& bytes) {
  const auto starts_with = [&](std::initializer_list<uint8_t> magic) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
  };
  if (starts_with({0x89, 'P', 'N', 'G'})) return "png";
  if (starts_with({0xFF, 0xD8, 0xFF})) return "jpeg";
  return "";
}

uint32_t big_endian(const std::vector<uint8_t>& bytes, size_t offset, size_t size) {
  uint32_t value = 0;
  for (size_t k = 0; k < size; ++k) value = value << 8 | bytes[offset + k];
  return value;
}

// Whether all chunks of a PNG lie within the file; libpng would print about those that do not.
bool is_whole_png(const std::vector<uint8_t>& bytes) {
  constexpr uint32_t kEnd = 0x49454E44u;  // "IEND"
  size_t offset = 8;
  while (offset + 12 <= bytes.size()) {
    const size_t length = big_endian(bytes, offset, 4);
    if (length > bytes.size() - offset - 12) return false;
    if (big_endian(bytes, offset + 4, 4) == kEnd) return true;
    offset += 12 + length;
  }
  return false;
}

// Whether a JPEG reaches its end marker; libjpeg fills what is missing with grey and says nothing.
bool is_whole_jpeg(const std::vector<uint8_t>& bytes) {
  size_t offset = 2;
  while (offset + 2 <= bytes.size()) {
    const uint8_t marker = bytes[offset + 1];
    const bool in_scan = bytes[offset] != 0xFF || marker == 0x00 || marker == 0xFF;
    if (in_scan) {
      ++offset;
    } else if (marker == 0xD9) {
      return true;
    } else if (marker >= 0xD0 && marker <= 0xD8) {
      offset += 2;
    } else {
      if (offset + 4 > bytes.size()) return false;
      offset += 2 + big_endian(bytes, offset + 2, 2);
    }
  }
  return false;
}

std::string reason_of(const std::string& error) {
  return error.empty() ? "unknown reason" : error.substr(0, error.find('\n'));
}

// Grey images hold grey or grey and alpha; glTF treats both as colour with equal channels.
void spread_channels(const std::vector<uint8_t>& samples, size_t channels, std::vector<uint8_t>& rgba) {
  const size_t count = samples.size() / channels;
  for (size_t i = 0; i < count; ++i) {
    const uint8_t* from = &samples[i * channels];
    uint8_t* to = &rgba[i * 4];
    const bool grey = channels < 3;
    for (size_t k = 0; k < 3; ++k) to[k] = from[grey ? 0 : k];
    to[3] = channels == 2 ? from[1] : channels >= 4 ? from[3] : uint8_t{255};
  }
}

}  // namespace

void run_parallel(size_t count, const std::function<void(size_t)>& task) {
  std::vector<std::exception_ptr> failures(count);
  std::atomic<size_t> next{0};
  const auto work = [&] {
    for (size_t i = next++; i < count; i = next++) {
      try {
        task(i);
      } catch (...) {
        failures[i] = std::current_exception();
      }
    }
  };
  const size_t helpers = std::min<size_t>(count, std::max(1u, std::thread::hardware_concurrency()));
  {
    std::vector<std::jthread> threads;
    for (size_t t = 1; t < helpers; ++t) threads.emplace_back(work);
    work();
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
}

Image decode_image(const std::vector<uint8_t>& bytes, const std::string& file, const std::string& name) {
  const std::string format = format_of(bytes);
  if (format.empty()) fail(file, name, "is not a PNG or JPEG image, expected one of these");
  if (!(format == "png" ? is_whole_png(bytes) : is_whole_jpeg(bytes))) {
    fail(file, name, "ends in the middle of its data, expected a whole image", "the image may be truncated");
  }
  OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::create(format);
  if (!input) fail(file, name, "cannot be decoded: " + reason_of(OIIO::geterror()));
  OIIO::ImageSpec spec;
  if (!input->set_ioproxy(&reader) || !input->open(format, spec, config)) {
    fail(file, name, "cannot be decoded: " + reason_of(input->geterror()), "the image may be truncated");
  }
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || int64_t{spec.width} * spec.height > kMaxTexels) {
    fail(file, name,
         "is " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " texels, expected at most " +
             std::to_string(kMaxTexels) + " in all");
  }
  Image image;
  image.name = name;
  image.width = static_cast<uint32_t>(spec.width);
  image.height = static_cast<uint32_t>(spec.height);
  const auto channels = static_cast<size_t>(std::min(spec.nchannels, 4));
  const size_t texels = size_t{image.width} * image.height;
  std::vector<uint8_t> samples(texels * channels);
  if (!input->read_image(0, 0, 0, static_cast<int>(channels), OIIO::TypeDesc::UINT8, samples.data())) {
    fail(file, name, "cannot be decoded: " + reason_of(input->geterror()), "the image may be truncated");
  }
  if (channels == 4) {
    image.rgba = std::move(samples);
  } else {
    image.rgba.resize(texels * 4);
    spread_channels(samples, channels, image.rgba);
  }
  return image;
}

std::vector<Image> load_images(const GltfFile& file, const std::vector<int>& indices) {
  std::vector<Image> images(indices.size());
  run_parallel(indices.size(), [&](size_t i) {
    stop_if_interrupted();
    const EncodedImage& encoded = file.images[static_cast<size_t>(indices[i])];
    images[i] = decode_image(read_encoded_image(file, encoded), file.name, encoded.name);
  });
  return images;
}

void load_environment(const std::filesystem::path& path, const std::string& wanted_by, Environment& environment) {
  if (!std::filesystem::is_regular_file(path)) {
    throw Error(ExitCode::invalid_input, wanted_by + ": the file " + path.string() + " does not exist");
  }
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input)
    throw Error(ExitCode::invalid_input,
                wanted_by + ": " + path.string() + " cannot be decoded: " + reason_of(OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 3 || int64_t{spec.width} * spec.height > kMaxTexels) {
    throw Error(ExitCode::invalid_input, wanted_by + ": " + path.string() + " is not an RGB image of at most " +
                                             std::to_string(kMaxTexels) + " texels");
  }
  environment.width = static_cast<uint32_t>(spec.width);
  environment.height = static_cast<uint32_t>(spec.height);
  environment.rgb.resize(size_t{environment.width} * environment.height * 3);
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, environment.rgb.data())) {
    throw Error(ExitCode::invalid_input,
                wanted_by + ": " + path.string() + " cannot be decoded: " + reason_of(input->geterror()));
  }
  for (const float value : environment.rgb) {
    if (!std::isfinite(value) || value < 0) {
      throw Error(ExitCode::invalid_input,
                  wanted_by + ": " + path.string() +
                      " holds a negative or infinite radiance, expected finite values of at least 0");
    }
  }
}

}  // namespace lightloom::scene
