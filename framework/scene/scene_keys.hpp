#pragma once

#include <array>
#include <cstdint>

#include "framework/base/key_table.hpp"
#include "framework/scene/json_members.hpp"

namespace lightloom::scene {

// The keys of scene files, object by object, and the ranges of their numbers.

constexpr int64_t kSceneFormatVersion = 1;

constexpr std::array<KeyDoc, 7> kSceneKeys{{
    {"$schema", "Where editors find the schema"},
    {"lightloom_scene", "Version of the format"},
    {"gltf", "The main glTF file (.gltf or .glb), relative to this one"},
    {"instances", "More glTF files, placed in the scene"},
    {"cameras", "Cameras by name, besides those of the glTF files"},
    {"sun", "A distant light"},
    {"environment", "Light from all around: a colour, or an image"},
}};

constexpr std::array<KeyDoc, 6> kInstanceKeys{{
    {"gltf", "The glTF file, relative to this one"},
    {"translation", "Where its origin goes [m]"},
    {"rotation_y_degrees", "Turn about +y, before it is moved"},
    {"scale", "Size, before it is turned"},
    {"time_offset_seconds", "So much later stands its animation"},
    {"animation", "Which of its animations, by index or name; the first unless given"},
}};

constexpr std::array<KeyDoc, 4> kCameraKeys{{
    {"eye", "Where it stands [m]"},
    {"target", "A point it looks at [m]"},
    {"up", "A direction that is up in the picture; +y unless given"},
    {"vertical_fov_degrees", "Angle of view from the bottom to the top of the picture"},
}};

constexpr std::array<KeyDoc, 3> kSunKeys{{
    {"direction", "The way its light travels; of any length but 0"},
    {"irradiance", "On a surface that faces it, red, green, blue [W/m^2]"},
    {"angular_radius_degrees", "Of its disc as seen from the scene; 0: a point"},
}};

constexpr std::array<KeyDoc, 3> kEnvironmentKeys{{
    {"radiance", "The same in all directions, red, green, blue [W/(m^2 sr)]"},
    {"image", "An image over all directions, longitude to the right, latitude down; relative to this file"},
    {"scale", "The image times this"},
}};

constexpr NumberRange kInstanceRotation{0, -1e6, 1e6};
constexpr NumberRange kInstanceScale{1, 1e-9, 1e9};
constexpr NumberRange kTimeOffset{0, -1e9, 1e9};
constexpr NumberRange kFieldOfView{45, 0.01, 179.9};
constexpr NumberRange kSunRadius{0, 0, 89};
constexpr NumberRange kEnvironmentScale{1, 0, 1e9};
constexpr int kMostAnimations = 1'000'000;

}  // namespace lightloom::scene
