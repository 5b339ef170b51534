#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "framework/stability/check.hpp"
#include "framework/stability/light_lab.hpp"

namespace lightloom::stability {
namespace {

/// A list of faces as shaders/stability/face_table.comp makes it up.
struct FaceList {
  const char* what;
  uint32_t count, leading, trailing, weight;
};

image::HostImage draw_faces(Lab& lab, const FaceList& list) {
  const auto number = [](uint32_t value) { return std::to_string(value); };
  return lab
      .last_frame(R"({ "lightloom": 1, "name": "face_edges", "passes": {
      "table": { "type": "compute", "shader": "stability/face_table.comp",
                 "out": { "faces": { "format": "rg32_uint", "size": "1024x8" } },
                 "params": { "count": )" +
                      number(list.count) + R"(, "leading": )" + number(list.leading) + R"(, "trailing": )" +
                      number(list.trailing) + R"(, "weight": )" + number(list.weight) + R"( } },
      "draws": { "type": "compute", "shader": "stability/face_edges.comp", "in": { "faces": "table.faces" },
                 "out": { "draws": { "size": "5x2" } } } }, "outputs": { "draws": "draws.draws" } })",
                  lamp_room())
      .at("draws");
}

std::vector<Figure> measure_lists(Lab& lab) {
  std::vector<Figure> figures;
  for (const FaceList& list :
       {FaceList{"one face", 1, 0, 0, 4095}, FaceList{"one face of the least weight", 1, 0, 0, 1},
        FaceList{"1000 faces", 1000, 0, 0, 7}, FaceList{"100 weightless ones first", 1000, 100, 0, 7},
        FaceList{"100 weightless ones last", 1000, 0, 100, 7},
        FaceList{"one between weightless ones", 1001, 500, 500, 3},
        FaceList{"8191 faces of the largest weight", 8191, 0, 0, 4095}}) {
    const image::HostImage draws = draw_faces(lab, list);
    double bad = 0;
    for (uint32_t word = 0; word < 5; ++word) {
      const double found = draws.at(word, 0, 0, 0), weight = draws.at(word, 0, 0, 1);
      const bool inside = found > list.leading && found <= list.count - list.trailing;
      if (!inside || weight != list.weight || !(draws.at(word, 0, 0, 2) > 0)) ++bad;
    }
    const std::string which = std::string(list.what) + ": ";
    figures.push_back(none(which + "draws of what is not in the list or has no weight, of 5", bad));
    figures.push_back(equal(which + "face of 0", draws.at(0, 0, 0, 0), list.leading + 1));
    figures.push_back(equal(which + "face of 1 - 2^-32", draws.at(4, 0, 0, 0), list.count - list.trailing));
  }
  const image::HostImage draws = draw_faces(lab, {"one face", 1, 0, 0, 4095});
  double dense = 0;
  for (uint32_t k = 0; k < 5; ++k) dense += draws.at(k, 1, 0, 0) == 0 ? 0 : 1;
  figures.push_back(
      none("densities other than 0 of points that touch, turn away or lie in their face's plane, of 5", dense));
  return figures;
}

std::vector<Figure> measure_light(Lab& lab) {
  std::vector<Figure> figures;
  const scene::Scene room = lamp_room();
  // In its plane no face is seen from the front but those of its rim.
  for (const auto& [place, name] : {std::pair(glm::vec3(0.03f, 0.7f, 0.02f), "below the lamp"),
                                    std::pair(glm::vec3(-0.8f, 1.2f, -0.7f), "under its corner"),
                                    std::pair(glm::vec3(0.1f, 1.8f, 0.1f), "a voxel below it"),
                                    std::pair(glm::vec3(1.7f, 1.9f, 0.1f), "beside it")}) {
    const image::HostImage light =
        lab.last_frame(R"({ "lightloom": 1, "name": "face_light_edges", "passes": {
        "voxelize": { "type": "voxelize", "params": { "geometry": "all", "resolution": 32 } },
        "distance": { "type": "distance_transform", "in": { "voxels": "voxelize.voxels" } },
        "faces": { "type": "emissive_faces", "in": { "voxels": "voxelize.voxels" } },
        "light": { "type": "compute", "shader": "stability/face_light_edges.comp",
                   "in": { "distance_field": "distance.distance", "voxels": "voxelize.voxels", "faces": "faces.faces",
                           "power": "faces.power" },
                   "out": { "light": { "size": "25x25" } }, "params": { "x": )" +
                           std::to_string(place.x) + R"(, "y": )" + std::to_string(place.y) + R"(, "z": )" +
                           std::to_string(place.z) + R"( } } }, "outputs": { "light": "light.light" } })",
                       room)
            .at("light");
    double bad = 0, lit = 0;
    for (uint32_t y = 0; y < 25; ++y)
      for (uint32_t x = 0; x < 25; ++x) {
        const double value = light.at(x, y, 0, 0);
        if (!std::isfinite(value) || value < 0) ++bad;
        if (value > 0) ++lit;
      }
    figures.push_back(none(std::string(name) + ": light that is not finite or below 0, of 625 draws", bad));
    if (std::string(name) != "beside it")
      figures.push_back(at_least(std::string(name) + ": draws that find light", lit, 5));
  }
  return figures;
}

}  // namespace

void add_table_checks(std::vector<Check>& checks) {
  const CheckGroup add(checks, "samplers");
  add("face_list_edges", "random numbers 0 to 1 - 2^-32 over lists of one face, and with weightless ones at their ends",
      "a face without weight is drawn with density 0, the search runs over the end",
      "the first sum above a target below the total: shaders/lib/emitters.glsl, find_face", measure_lists);
  add("face_light_edges", "the same in all four numbers of a draw from a lamp's faces, at points around it",
      "points on the rim of a face lie in two voxels, in its plane the density is infinite",
      "densities by face_solid_angle_pdf, only the voxel that was drawn counts: shaders/lib/emitters.glsl, face_light",
      measure_light);
}

}  // namespace lightloom::stability
