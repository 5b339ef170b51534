#include "framework/scene/images.hpp"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <optional>
#include <thread>

#include "framework/base/image_header.hpp"
#include "framework/base/interrupt.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/input_context.hpp"

namespace lightloom::scene {
namespace {

std::string reason_of(const std::string& error) {
  return error.empty() ? "unknown reason" : error.substr(0, error.find('\n'));
}

const char* oiio_name(ImageFileFormat format) {
  switch (format) {
    case ImageFileFormat::png:
      return "png";
    case ImageFileFormat::jpeg:
      return "jpeg";
    case ImageFileFormat::hdr:
      return "hdr";
    default:
      return "openexr";
  }
}

/// A decoder that reads another size out of the file than we did would be given too little memory, or too much.
void require_as_in_header(const OIIO::ImageSpec& spec, const ImageHeader& header, const std::string& name) {
  const bool same = spec.width >= 1 && spec.height >= 1 && spec.nchannels >= 1 &&
                    static_cast<uint64_t>(spec.width) <= header.width &&
                    static_cast<uint64_t>(spec.height) <= header.height;
  if (same) return;
  throw Error(ExitCode::invalid_input, name + " is " + std::to_string(header.width) + " x " +
                                           std::to_string(header.height) + " by its header and " +
                                           std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                                           " by its decoder, expected one size");
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

ImageHeader check_texture(const std::vector<uint8_t>& bytes, const std::string& file, const std::string& name,
                          const Limits& limits) {
  const ImageFileFormat format = image_file_format(bytes);
  if (format != ImageFileFormat::png && format != ImageFileFormat::jpeg)
    fail(file, name, "is not a PNG or JPEG image, expected one of these");
  std::string problem;
  const std::optional<ImageHeader> header = read_image_header(bytes, problem);
  if (!header) fail(file, name, problem, "the image may be truncated");
  require_image_within(*header, limits, &Limits::image_texels, file + ": " + name);
  if (!header->whole)
    fail(file, name, "ends in the middle of its data, expected a whole image", "the image may be truncated");
  return *header;
}

Image decode_image(const std::vector<uint8_t>& bytes, const std::string& file, const std::string& name,
                   const Limits& limits, std::mutex* opening) {
  const ImageHeader header = check_texture(bytes, file, name, limits);
  const std::string format = header.format == ImageFileFormat::png ? "png" : "jpeg";
  OIIO::Filesystem::IOMemReader reader(bytes.data(), bytes.size());
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::create(format);
  if (!input) fail(file, name, "cannot be decoded: " + reason_of(OIIO::geterror()));
  OIIO::ImageSpec spec;
  // OpenImageIO 2.4 fills a table of its own with what it meets in colour profiles, whoever else does so meanwhile.
  const bool open = [&] {
    const std::unique_lock one_at_a_time = opening ? std::unique_lock(*opening) : std::unique_lock<std::mutex>();
    return input->set_ioproxy(&reader) && input->open(format, spec, config);
  }();
  if (!open) {
    fail(file, name, "cannot be decoded: " + reason_of(input->geterror()), "the image may be truncated");
  }
  require_as_in_header(spec, header, file + ": " + name);
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
  std::vector<std::vector<uint8_t>> encoded(indices.size());
  for (size_t i = 0; i < indices.size(); ++i) {
    const EncodedImage& source = file.images[static_cast<size_t>(indices[i])];
    encoded[i] = read_encoded_image(file, source);
    const ImageHeader header = check_texture(encoded[i], file.name, source.name, file.context->limits());
    file.context->spend_image(header.width * header.height, file.name + ": " + source.name);
  }
  std::vector<Image> images(indices.size());
  std::mutex opening;
  run_parallel(indices.size(), [&](size_t i) {
    stop_if_interrupted();
    const std::string& name = file.images[static_cast<size_t>(indices[i])].name;
    images[i] = decode_image(encoded[i], file.name, name, file.context->limits(), &opening);
    encoded[i] = {};
  });
  return images;
}

void load_environment(const std::filesystem::path& path, const std::string& wanted_by, Environment& environment,
                      const LoadOptions& options) {
  const std::vector<uint8_t> bytes = InputContext(path, options).read(path, wanted_by);
  const std::string name = wanted_by + ": " + path.string();
  std::string problem;
  const std::optional<ImageHeader> header = read_image_header(bytes, problem);
  if (!header) throw Error(ExitCode::invalid_input, name + " " + problem);
  require_image_within(*header, options.limits, &Limits::float_texels, name);
  // By the content, whatever the file is called: OpenImageIO would try every format it knows.
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(oiio_name(header->format));
  OIIO::ImageSpec spec;
  if (!input || !input->open(path.string(), spec, OIIO::ImageSpec())) {
    throw Error(ExitCode::invalid_input,
                name + " cannot be decoded: " + reason_of(input ? input->geterror() : OIIO::geterror()));
  }
  if (spec.nchannels < 3 || spec.depth > 1 || spec.deep)
    throw Error(ExitCode::invalid_input, name + " is not a flat RGB image, expected one");
  require_as_in_header(spec, *header, name);
  environment.width = static_cast<uint32_t>(spec.width);
  environment.height = static_cast<uint32_t>(spec.height);
  environment.rgb.resize(size_t{environment.width} * environment.height * 3);
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::FLOAT, environment.rgb.data()))
    throw Error(ExitCode::invalid_input, name + " cannot be decoded: " + reason_of(input->geterror()));
  for (const float value : environment.rgb) {
    if (!std::isfinite(value) || value < 0) {
      throw Error(ExitCode::invalid_input,
                  name + " holds a negative or infinite radiance, expected finite values of at least 0");
    }
  }
}

}  // namespace lightloom::scene
