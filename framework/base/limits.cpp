#include "framework/base/limits.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/text.hpp"

namespace lightloom {
namespace {

constexpr uint64_t kMostBytes = uint64_t{1} << 53;
constexpr uint64_t kMostIndices = (uint64_t{1} << 31) - 1;

constexpr std::array<LimitInfo, 23> kTable{{
    {"file_bytes", &Limits::file_bytes, "bytes", "Size of one file that a scene reads: glTF, buffer, image",
     kMostBytes},
    {"total_bytes", &Limits::total_bytes, "bytes",
     "Bytes read for one scene from all files, data URIs and buffer views of images together", kMostBytes},
    {"json_bytes", &Limits::json_bytes, "bytes", "JSON of a glTF file, a scene file or a camera path",
     (uint64_t{1} << 32) - 1},
    {"json_depth", &Limits::json_depth, "levels",
     "Arrays and objects within each other in a glTF file; readers recurse", 1000},
    {"json_values", &Limits::json_values, "values",
     "Values in a JSON file, an object counted as four as it takes more memory", kMostBytes},
    {"elements", &Limits::elements, "elements",
     "Elements of one array of a glTF file (accessors, meshes, materials, ...)", kMostIndices},
    {"name_bytes", &Limits::name_bytes, "bytes", "Length of a name in a glTF file, as each instance keeps it",
     kMostBytes},
    {"nodes", &Limits::nodes, "nodes", "Nodes of a glTF file, and of all instances of a scene together", kMostIndices},
    {"node_depth", &Limits::node_depth, "levels", "Nodes below each other", kMostIndices},
    {"vertices", &Limits::vertices, "vertices",
     "Vertices of a glTF file, and of a scene with all instances (64 bytes each)", kMostIndices},
    {"triangles", &Limits::triangles, "triangles",
     "Triangles of a glTF file, and of a scene with all instances (20 bytes each)", kMostIndices},
    {"accessor_values", &Limits::accessor_values, "values",
     "Numbers read from the accessors of a glTF file; counted again for each use of an accessor", kMostBytes},
    {"animation_values", &Limits::animation_values, "values", "Keys of all animations that play, times and components",
     kMostBytes},
    {"morph_weights", &Limits::morph_weights, "weights", "Morph targets of all nodes together", kMostBytes},
    {"joints", &Limits::joints, "joints", "Joints of the skins of all drawn primitives together", kMostBytes},
    {"posed_elements", &Limits::posed_elements, "vertices and nodes",
     "Vertices and nodes posed to find how far animations reach, over all moments and instances", kMostBytes},
    {"images", &Limits::images, "images", "Images that the materials of a scene use", kMostIndices},
    {"image_side", &Limits::image_side, "texels", "Width or height of an image", kMostIndices},
    {"image_texels", &Limits::image_texels, "texels", "One image of a texture (4 bytes a texel)", kMostIndices},
    {"float_texels", &Limits::float_texels, "texels",
     "One environment or compared image (16 bytes a texel); one with more than four channels counts as several",
     kMostIndices},
    {"texture_texels", &Limits::texture_texels, "texels", "All images of the textures of a scene", kMostBytes},
    {"page_texels", &Limits::page_texels, "texels",
     "Texture pages: images are resampled to at most 12 sizes, which can make small ones large", kMostBytes},
    {"jpeg_scans", &Limits::jpeg_scans, "scans",
     "Scans of a progressive JPEG image, each of which takes the time of a whole image", kMostBytes},
}};

const LimitInfo& info_of(uint64_t Limits::*limit) {
  return *std::find_if(kTable.begin(), kTable.end(), [&](const LimitInfo& info) { return info.value == limit; });
}

}  // namespace

std::span<const LimitInfo> limit_table() {
  return kTable;
}

std::string set_limit(Limits& limits, std::string_view name, std::string_view value) {
  const auto info = std::find_if(kTable.begin(), kTable.end(), [&](const LimitInfo& row) { return row.name == name; });
  if (info == kTable.end()) {
    std::vector<std::string> names;
    for (const LimitInfo& row : kTable) names.emplace_back(row.name);
    const std::string hint = did_you_mean(name, names, "limits are");
    return "there is no limit " + in_quotes(name) + (hint.empty() ? "" : "; " + hint);
  }
  uint64_t number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error != std::errc{} || end != value.data() + value.size() || number < 1 || number > info->most)
    return "limit " + std::string(name) + " is " + in_quotes(value) + ", expected an integer from 1 to " +
           std::to_string(info->most);
  limits.*(info->value) = number;
  return "";
}

void refuse_beyond(const Limits& limits, uint64_t Limits::*limit, const std::string& element, uint64_t claimed) {
  const LimitInfo& info = info_of(limit);
  const std::string option = "--limit " + std::string(info.name) + "=";
  throw Error(ExitCode::invalid_input,
              element + " has " + std::to_string(claimed) + " " + std::string(info.noun) + ", more than the limit of " +
                  std::to_string(limits.*limit),
              claimed <= info.most ? option + std::to_string(claimed) + " lets it through"
                                   : option + "N raises the limit, up to " + std::to_string(info.most));
}

}  // namespace lightloom
