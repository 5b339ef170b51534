#include "framework/scene/texture_pages.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "framework/scene/color.hpp"
#include "framework/scene/fail.hpp"
#include "framework/scene/gltf_materials.hpp"
#include "framework/scene/images.hpp"

namespace lightloom::scene {
namespace {

struct ImageUse {
  bool srgb = false, linear = false;
  std::optional<float> alpha_cutoff;  ///< of the first material that masks with it
};

std::vector<ImageUse> find_uses(const Scene& scene) {
  std::vector<ImageUse> uses(scene.images.size());
  for (Material material : scene.materials) {
    for (const TextureUseRef& ref : texture_uses(material)) {
      if (ref.use->image < 0) continue;
      ImageUse& use = uses[static_cast<size_t>(ref.use->image)];
      (ref.srgb ? use.srgb : use.linear) = true;
    }
    const int32_t base = material.base_color_texture.image;
    if (material.alpha_mode == AlphaMode::mask && base >= 0 && !uses[static_cast<size_t>(base)].alpha_cutoff) {
      uses[static_cast<size_t>(base)].alpha_cutoff = material.alpha_cutoff;
    }
  }
  return uses;
}

using Classes =
    std::map<std::tuple<bool, uint32_t, uint32_t>, std::vector<uint32_t>>;  ///< (srgb, width, height) -> images

Classes find_classes(const Scene& scene, const std::vector<ImageUse>& uses) {
  Classes classes;
  for (uint32_t i = 0; i < uses.size(); ++i) {
    const Image& image = scene.images[i];
    if (uses[i].srgb) classes[{true, image.width, image.height}].push_back(i);
    if (uses[i].linear) classes[{false, image.width, image.height}].push_back(i);
  }
  return classes;
}

uint64_t texels_of(const Classes::value_type& entry) {
  return uint64_t{std::get<1>(entry.first)} * std::get<2>(entry.first) * entry.second.size();
}

// The class of the same colour space that loses least: the smallest that is at least as large in both directions, else
// the largest there is.
Classes::iterator find_host(Classes& classes, Classes::iterator guest) {
  const auto [srgb, width, height] = guest->first;
  const auto area = [](const Classes::iterator& it) {
    return uint64_t{std::get<1>(it->first)} * std::get<2>(it->first);
  };
  Classes::iterator best = classes.end(), largest = classes.end();
  for (auto it = classes.begin(); it != classes.end(); ++it) {
    if (it == guest || std::get<0>(it->first) != srgb) continue;
    if (largest == classes.end() || area(it) > area(largest)) largest = it;
    const bool covers = std::get<1>(it->first) >= width && std::get<2>(it->first) >= height;
    if (covers && (best == classes.end() || area(it) < area(best))) best = it;
  }
  return best != classes.end() ? best : largest;
}

void merge_smallest(Classes& classes, const Scene& scene, std::vector<std::string>& warnings) {
  std::array<size_t, 2> of_space{};
  for (const auto& [key, images] : classes) ++of_space[std::get<0>(key) ? 1 : 0];
  Classes::iterator smallest = classes.end();
  for (auto it = classes.begin(); it != classes.end(); ++it) {
    const bool alone = of_space[std::get<0>(it->first) ? 1 : 0] == 1;
    if (!alone && (smallest == classes.end() || texels_of(*it) < texels_of(*smallest))) smallest = it;
  }
  const Classes::iterator host = find_host(classes, smallest);
  for (const uint32_t image : smallest->second) {
    warnings.push_back(scene.images[image].name + " is resampled from " + std::to_string(scene.images[image].width) +
                       " x " + std::to_string(scene.images[image].height) + " to " +
                       std::to_string(std::get<1>(host->first)) + " x " + std::to_string(std::get<2>(host->first)) +
                       ", as images of at most " + std::to_string(kTexturePageCount) + " different sizes fit");
    host->second.push_back(image);
  }
  std::sort(host->second.begin(), host->second.end());
  classes.erase(smallest);
}

std::vector<uint8_t> resample(const Image& image, uint32_t width, uint32_t height) {
  if (image.width == width && image.height == height) return image.rgba;
  const OIIO::ImageSpec from(static_cast<int>(image.width), static_cast<int>(image.height), 4, OIIO::TypeDesc::UINT8);
  const OIIO::ImageSpec to(static_cast<int>(width), static_cast<int>(height), 4, OIIO::TypeDesc::UINT8);
  std::vector<uint8_t> source = image.rgba;
  std::vector<uint8_t> result(size_t{width} * height * 4);
  const OIIO::ImageBuf source_buffer(from, source.data());
  OIIO::ImageBuf result_buffer(to, result.data());
  if (!OIIO::ImageBufAlgo::resize(result_buffer, source_buffer, "triangle", 0.0f, {}, 1)) {
    throw Error(ExitCode::run_failed, image.name + " cannot be resampled: " + result_buffer.geterror());
  }
  return result;
}

double coverage(const std::vector<uint8_t>& rgba, float cutoff) {
  size_t covered = 0;
  for (size_t i = 3; i < rgba.size(); i += 4) covered += static_cast<float>(rgba[i]) >= cutoff * 255.0f ? 1u : 0u;
  return static_cast<double>(covered) / static_cast<double>(rgba.size() / 4);
}

// Scales alpha so that the share of texels that pass the cutoff comes closest to `wanted`.
void keep_coverage(std::vector<uint8_t>& rgba, float cutoff, double wanted) {
  std::array<size_t, 256> histogram{};
  for (size_t i = 3; i < rgba.size(); i += 4) ++histogram[rgba[i]];
  const double total = static_cast<double>(rgba.size() / 4);
  size_t passing = 0;
  int best = 255;
  double best_error = std::abs(wanted);
  for (int level = 255; level >= 1; --level) {
    passing += histogram[static_cast<size_t>(level)];
    const double error = std::abs(static_cast<double>(passing) / total - wanted);
    if (error < best_error) {
      best_error = error;
      best = level;
    }
  }
  const float scale = std::ceil(cutoff * 255.0f) / static_cast<float>(best);
  for (size_t i = 3; i < rgba.size(); i += 4) {
    rgba[i] = static_cast<uint8_t>(std::min(255.0f, std::ceil(static_cast<float>(rgba[i]) * scale)));
  }
}

void fill_layer(const Scene& scene, const ImageUse& use, uint32_t layer, TexturePage& page) {
  std::vector<uint8_t> level = resample(scene.images[page.images[layer]], page.width, page.height);
  const bool masks = page.srgb && use.alpha_cutoff && *use.alpha_cutoff > 0 && *use.alpha_cutoff <= 1;
  const double wanted = masks ? coverage(level, *use.alpha_cutoff) : 0;
  uint32_t width = page.width, height = page.height;
  for (size_t m = 0; m < page.mips.size(); ++m) {
    std::vector<uint8_t> stored = level;
    if (masks && m > 0) keep_coverage(stored, *use.alpha_cutoff, wanted);
    std::copy(stored.begin(), stored.end(), page.mips[m].begin() + static_cast<std::ptrdiff_t>(layer * stored.size()));
    if (m + 1 == page.mips.size()) break;
    level = halve_image(level, width, height, page.srgb);
    width = std::max(1u, width / 2);
    height = std::max(1u, height / 2);
  }
}

void allocate_mips(TexturePage& page) {
  for (uint32_t width = page.width, height = page.height;;
       width = std::max(1u, width / 2), height = std::max(1u, height / 2)) {
    page.mips.emplace_back(size_t{width} * height * 4 * page.images.size());
    if (width == 1 && height == 1) return;
  }
}

// Source texels that a destination texel covers along one direction, with their weights.
struct Tap {
  uint32_t first = 0;
  std::array<float, 3> weights{};  ///< sum 1
};
std::vector<Tap> halving_taps(uint32_t size) {
  const uint32_t halved = std::max(1u, size / 2);
  std::vector<Tap> taps(halved);
  const double ratio = static_cast<double>(size) / halved;
  for (uint32_t i = 0; i < halved; ++i) {
    const double begin = i * ratio, end = (i + 1) * ratio;
    taps[i].first = static_cast<uint32_t>(begin);
    for (uint32_t k = 0; k < 3; ++k) {
      const double left = std::max(begin, static_cast<double>(taps[i].first + k)),
                   right = std::min(end, static_cast<double>(taps[i].first + k + 1));
      taps[i].weights[k] = static_cast<float>(std::max(0.0, right - left) / ratio);
    }
  }
  return taps;
}

uint8_t encode_srgb(float linear) {
  // 8192 steps are finer than a code everywhere but in the first few codes of the linear foot, which they still
  // resolve.
  static const std::vector<uint8_t> table = [] {
    std::vector<uint8_t> codes(8193);
    for (size_t i = 0; i < codes.size(); ++i) codes[i] = linear_to_srgb(static_cast<float>(i) / 8192.0f);
    return codes;
  }();
  return table[static_cast<size_t>(linear * 8192.0f + 0.5f)];
}

}  // namespace

std::vector<uint8_t> halve_image(const std::vector<uint8_t>& rgba, uint32_t width, uint32_t height, bool srgb) {
  const std::vector<Tap> columns = halving_taps(width), rows = halving_taps(height);
  std::vector<uint8_t> result(columns.size() * rows.size() * 4);
  for (size_t y = 0; y < rows.size(); ++y) {
    for (size_t x = 0; x < columns.size(); ++x) {
      std::array<float, 4> sum{};
      for (uint32_t j = 0; j < 3; ++j) {
        for (uint32_t i = 0; i < 3; ++i) {
          const float weight = rows[y].weights[j] * columns[x].weights[i];
          if (weight == 0) continue;
          const uint8_t* texel = &rgba[((size_t{rows[y].first} + j) * width + columns[x].first + i) * 4];
          for (size_t k = 0; k < 3; ++k)
            sum[k] += weight * (srgb ? srgb_to_linear(texel[k]) : static_cast<float>(texel[k]));
          sum[3] += weight * static_cast<float>(texel[3]);
        }
      }
      uint8_t* out = &result[(y * columns.size() + x) * 4];
      for (size_t k = 0; k < 3; ++k)
        out[k] = srgb ? encode_srgb(std::min(sum[k], 1.0f)) : static_cast<uint8_t>(sum[k] + 0.5f);
      out[3] = static_cast<uint8_t>(sum[3] + 0.5f);
    }
  }
  return result;
}

void require_texture_pages_within(const Scene& scene, const Limits& limits) {
  Classes classes = find_classes(scene, find_uses(scene));
  std::vector<std::string> warnings;
  while (classes.size() > kTexturePageCount) merge_smallest(classes, scene, warnings);
  uint64_t texels = 0;
  for (const auto& entry : classes) texels += texels_of(entry);
  require_within(limits, &Limits::page_texels,
                 scene.file.string() + ": the texture array of at most " + std::to_string(kTexturePageCount) + " sizes",
                 texels);
}

TexturePages build_texture_pages(const Scene& scene) {
  const std::vector<ImageUse> uses = find_uses(scene);
  Classes classes = find_classes(scene, uses);
  TexturePages result;
  while (classes.size() > kTexturePageCount) merge_smallest(classes, scene, result.warnings);
  result.srgb_places.resize(scene.images.size());
  result.linear_places.resize(scene.images.size());
  std::vector<std::pair<uint32_t, uint32_t>> layers;
  for (const auto& [key, images] : classes) {
    TexturePage& page = result.pages.emplace_back();
    std::tie(page.srgb, page.width, page.height) = key;
    page.images = images;
    const auto page_index = static_cast<uint32_t>(result.pages.size() - 1);
    for (uint32_t layer = 0; layer < images.size(); ++layer) {
      (page.srgb ? result.srgb_places : result.linear_places)[images[layer]] = {page_index, layer};
      layers.emplace_back(page_index, layer);
    }
    allocate_mips(page);
  }
  run_parallel(layers.size(), [&](size_t i) {
    TexturePage& page = result.pages[layers[i].first];
    fill_layer(scene, uses[page.images[layers[i].second]], layers[i].second, page);
  });
  return result;
}

}  // namespace lightloom::scene
