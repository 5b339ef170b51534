#include "framework/image/read_image.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/base/image_header.hpp"
#include "framework/base/input_file.hpp"
#include "framework/base/text.hpp"
#include "framework/image/npy.hpp"
#include "framework/image/oiio_io.hpp"

namespace lightloom::image {
namespace {

using Channels = std::vector<size_t>;  ///< indices of one or three

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& cause, const std::string& hint = {}) {
  throw Error(ExitCode::invalid_input, "cannot read '" + file.string() + "' as an image: " + cause, hint);
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

/// Where the names are, all of them, whatever their case.
std::optional<Channels> find_all(const std::vector<std::string>& names, const std::vector<std::string>& wanted) {
  Channels found;
  for (const std::string& name : wanted) {
    const auto at = std::find_if(names.begin(), names.end(),
                                 [&](const std::string& candidate) { return lower(candidate) == lower(name); });
    if (at == names.end()) return std::nullopt;
    found.push_back(static_cast<size_t>(at - names.begin()));
  }
  return found;
}

/// Names for `--channel`: the layers that have a red, and all channels.
std::vector<std::string> channels_and_layers(const std::vector<std::string>& names) {
  std::vector<std::string> choices;
  for (const std::string& name : names)
    if (lower(name).ends_with(".r")) choices.push_back(name.substr(0, name.size() - 2));
  choices.insert(choices.end(), names.begin(), names.end());
  return choices;
}

Channels choose_by_name(const std::filesystem::path& file, const std::vector<std::string>& names,
                        const std::string& wanted) {
  if (const auto exact = std::find(names.begin(), names.end(), wanted); exact != names.end())
    return {static_cast<size_t>(exact - names.begin())};
  for (const std::vector<std::string>& choice : {std::vector{wanted},
                                                 {wanted + ".R", wanted + ".G", wanted + ".B"},
                                                 {wanted + ".X", wanted + ".Y", wanted + ".Z"}})
    if (const auto found = find_all(names, choice)) return *found;
  fail(file, "it has no channel or layer " + in_quotes(wanted),
       did_you_mean(wanted, channels_and_layers(names), "there are"));
}

Channels choose_channels(const std::filesystem::path& file, const OIIO::ImageSpec& spec, const std::string& wanted) {
  const std::vector<std::string>& names = spec.channelnames;
  if (!wanted.empty()) return choose_by_name(file, names, wanted);
  if (const auto colors = find_all(names, {"R", "G", "B"})) return *colors;
  if (const auto vector = find_all(names, {"X", "Y", "Z"})) return *vector;
  Channels rest;
  for (size_t channel = 0; channel < names.size(); ++channel)
    if (static_cast<int>(channel) != spec.alpha_channel) rest.push_back(channel);
  if (rest.size() == 1 || rest.size() == 3) return rest;
  fail(file, "it is not clear which of its channels are meant",
       "--channel NAME chooses; there are: " + join(channels_and_layers(names), ", "));
}

float remove_srgb_transfer(float value) {
  return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/// 8 or 16 bits that stand for 0..1.
bool is_display(const OIIO::TypeDesc& type) {
  return type.basetype == OIIO::TypeDesc::UINT8 || type.basetype == OIIO::TypeDesc::UINT16;
}

HostImage select(const std::vector<float>& samples, const OIIO::ImageSpec& spec, const Channels& channels,
                 const std::function<float(float)>& decode) {
  const bool grey = channels.size() == 1;
  HostImage image;
  image.desc = {grey ? Format::r32_sfloat : Format::rgba32_sfloat,
                Dimension::d2,
                {static_cast<uint32_t>(spec.width), static_cast<uint32_t>(spec.height), 1}};
  image.texels.resize(byte_size(image.desc));
  const auto step = static_cast<size_t>(spec.nchannels);
  std::byte* to = image.texels.data();
  for (size_t from = 0; from < samples.size(); from += step) {
    std::array<float, 4> texel = {0, 0, 0, 1};
    for (size_t c = 0; c < channels.size(); ++c) texel[c] = decode(samples[from + channels[c]]);
    const size_t bytes = sizeof(float) * (grey ? 1 : 4);
    std::memcpy(to, texel.data(), bytes);
    to += bytes;
  }
  return image;
}

ReadImage read_numpy(const std::filesystem::path& file, const ReadOptions& options) {
  if (!options.channel.empty()) fail(file, "the channels of .npy files have no names to choose by");
  ReadImage result{read_npy(file, &options.limits), false, false};
  result.display = channel_type(result.image.desc.format) == ChannelType::unorm8;
  return result;
}

/// Other formats than the four are left to OpenImageIO, and asked for their size when it has opened them.
void require_file_within(const std::filesystem::path& file, const Limits& limits) {
  InputFile source(file);
  if (source.problem() == "does not exist") fail(file, "there is no such file");
  if (!source.problem().empty()) fail(file, "it " + source.problem());
  require_within(limits, &Limits::file_bytes, "'" + file.string() + "'", source.size());
  std::vector<uint8_t> bytes(static_cast<size_t>(source.size()));
  if (!source.read(bytes.data(), bytes.size())) fail(file, "it cannot be read");
  if (image_file_format(bytes) == ImageFileFormat::unknown) return;
  std::string problem;
  const std::optional<ImageHeader> header = read_image_header(bytes, problem);
  if (!header) fail(file, "it " + problem);
  require_image_within(*header, limits, &Limits::float_texels, "'" + file.string() + "'");
}

}  // namespace

ReadImage read_image(const std::filesystem::path& file, const ReadOptions& options) {
  if (lower(file.extension().string()) == ".npy") return read_numpy(file, options);
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  require_file_within(file, options.limits);
  const std::unique_ptr<OIIO::ImageInput> input = open_image(file, config);
  const OIIO::ImageSpec& spec = input->spec();
  require_image_within({.width = static_cast<uint64_t>(spec.width),
                        .height = static_cast<uint64_t>(spec.height),
                        .channels = static_cast<uint64_t>(spec.nchannels)},
                       options.limits, &Limits::float_texels, "'" + file.string() + "'");
  const Channels channels = choose_channels(file, spec, options.channel);
  const OIIO::TypeDesc type = spec.channelformat(static_cast<int>(channels.front()));
  if (!is_display(type) && !type.is_floating_point())
    fail(file, std::string("its samples are of type ") + type.c_str());
  std::vector<float> samples(static_cast<size_t>(spec.width) * static_cast<size_t>(spec.height) *
                             static_cast<size_t>(spec.nchannels));
  read_samples(*input, file, OIIO::TypeDesc::FLOAT, samples.data());
  ReadImage result;
  result.display = is_display(type);
  const std::string space = lower(spec.get_string_attribute("oiio:ColorSpace"));
  result.decoded = result.display && !options.linear && space != "linear" && space != "raw";
  const auto as_it_is = [](float value) { return value; };
  result.image = result.decoded ? select(samples, spec, channels, remove_srgb_transfer)
                                : select(samples, spec, channels, as_it_is);
  return result;
}

}  // namespace lightloom::image
