#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <random>

#include "framework/base/error.hpp"
#include "framework/scene/load_options.hpp"
#include "tests/scene/gltf_builder.hpp"

namespace lightloom::scene {
namespace {

using nlohmann::json;
using test::GltfBuilder;
using test::TemporaryFolder;
using ::testing::HasSubstr;

/// "" if the file loads, else the error's sentence.
std::string verdict(const std::filesystem::path& file) {
  try {
    const Scene scene = load_scene(file);
    EXPECT_FALSE(scene.triangles.empty()) << file;
    for (const Triangle& triangle : scene.triangles)
      EXPECT_LT(std::max({triangle.a, triangle.b, triangle.c}), scene.vertices.size()) << file;
    for (const Vertex& vertex : scene.vertices)
      EXPECT_TRUE(std::isfinite(glm::dot(vertex.position, vertex.position) +
                                glm::dot(vertex.normal, glm::vec3(vertex.tangent))))
          << file;
    (void)pose(scene, 0.3);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    EXPECT_GT(std::string(error.what()).size(), 10u);
    return error.what();
  }
}

/// A file with a mesh, a skin, a material with a texture, an animation, a camera and a light: something to break.
json rich_document() {
  GltfBuilder builder;
  builder.append("images",
                 {{"uri", "data:image/png;base64," + test::to_base64(test::make_png(1, 1, 8, 2, {1, 2, 3}))}});
  builder.append("samplers", {{"wrapS", 10497}});
  builder.append("textures", {{"source", 0}, {"sampler", 0}});
  builder.append("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  const int mesh = builder.quad(0);
  auto& primitive = builder.json["meshes"][mesh]["primitives"][0];
  primitive["attributes"]["JOINTS_0"] =
      builder.accessor<uint16_t>({0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, "VEC4");
  primitive["attributes"]["WEIGHTS_0"] =
      builder.accessor<float>({1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 3, 0, 0}, "VEC4");
  primitive["targets"] = {{{"POSITION", builder.accessor<float>({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3")}}};
  const int bind = builder.accessor<float>(
      {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -5, 0, 1}, "MAT4");
  builder.append("cameras", {{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}});
  builder.node({{"mesh", mesh}, {"skin", 0}});
  builder.node({{"children", {2}}, {"camera", 0}});
  builder.node({{"translation", {0, 5, 0}}});
  builder.append("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", bind}});
  builder.animation(2, "translation", {0, 1}, {0, 5, 0, 0, 5, 4});
  builder.animation(0, "weights", {0, 1}, {0, 1});
  builder.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
  builder.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = 0;
  builder.json["scenes"] = {{{"nodes", {0, 1}}}};
  builder.json["scene"] = 0;
  return builder.finished();
}

struct Breakage {
  const char* name;
  std::function<void(json&)> apply;
  const char* expected;  ///< part of the sentence
};

/// JSON pointers to everything that is an index, and to byte sizes.
std::vector<Breakage> breakages() {
  std::vector<Breakage> all;
  static const std::vector<std::string> indices = {"/accessors/0/bufferView",
                                                   "/bufferViews/0/buffer",
                                                   "/meshes/0/primitives/0/indices",
                                                   "/meshes/0/primitives/0/material",
                                                   "/meshes/0/primitives/0/attributes/POSITION",
                                                   "/meshes/0/primitives/0/targets/0/POSITION",
                                                   "/nodes/0/mesh",
                                                   "/nodes/0/skin",
                                                   "/nodes/1/camera",
                                                   "/nodes/1/children/0",
                                                   "/nodes/1/extensions/KHR_lights_punctual/light",
                                                   "/skins/0/joints/0",
                                                   "/skins/0/inverseBindMatrices",
                                                   "/textures/0/source",
                                                   "/textures/0/sampler",
                                                   "/materials/0/pbrMetallicRoughness/baseColorTexture/index",
                                                   "/scene",
                                                   "/scenes/0/nodes/0",
                                                   "/animations/0/samplers/0/input",
                                                   "/animations/0/samplers/0/output",
                                                   "/animations/0/channels/0/target/node"};
  for (const std::string& pointer : indices) {
    for (const json& value : {json(99), json(-1), json("0"), json(0.5), json(1e300), json(nullptr)}) {
      all.push_back({pointer.c_str(), [pointer, value](json& d) { d[json::json_pointer(pointer)] = value; },
                     "expected an index into"});
    }
  }
  const auto set = [&](const char* name, const char* pointer, const json& value, const char* expected) {
    all.push_back({name, [pointer, value](json& d) { d[json::json_pointer(pointer)] = value; }, expected});
  };
  set("sampler index", "/animations/0/channels/0/sampler", 1, "expected an index into samplers");
  set("buffer too short", "/buffers/0/byteLength", 1000000, "expected byteLength 1000000");
  set("view past the end", "/bufferViews/0/byteOffset", 900000, "reaches past the end of its buffer");
  set("view offset written as a real", "/bufferViews/0/byteOffset", 1e15, "expected an integer");
  set("view offset overflow", "/bufferViews/0/byteOffset", 9007199254740992, "reaches past the end of its buffer");
  set("accessor past the end", "/accessors/0/count", 5, "reach past the end of bufferViews[0]");
  set("huge accessor", "/accessors/0/count", 2000000000, "reach past the end");
  set("accessor offset", "/accessors/0/byteOffset", 9007199254740000, "reach past the end");
  set("stride below the element", "/bufferViews/0/byteStride", 8, "byteStride is 8, expected at least the 12 bytes");
  set("attribute counts differ", "/accessors/1/count", 3, "has 3 elements, expected 4 as POSITION has");
  set("index accessor of signed integers", "/accessors/3/componentType", 5122, "expected SCALAR of u8 u16 u32");
  set("positions of the wrong type", "/accessors/0/type", "VEC2", "is VEC2 of float, expected VEC3");
  set("unknown component type", "/accessors/0/componentType", 5124, "expected one of 5120, 5121");
  set("unknown accessor type", "/accessors/0/type", "VEC5", "expected one of SCALAR");
  set("two parents", "/nodes/0/children", {2}, "expected a node without a parent");
  set("own child", "/nodes/2/children", {2}, "expected a node without a parent");
  set("zero rotation", "/nodes/2/rotation", {0, 0, 0, 0}, "rotation is zero");
  set("short translation", "/nodes/2/translation", {0, 0}, "expected an array of 3 numbers");
  set("wrong type in translation", "/nodes/2/translation", {0, 0, "x"}, "expected a number");
  set("perspective matrix", "/nodes/1/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
      "is not an affine transform");
  set("animated matrix", "/nodes/2/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "which has a matrix");
  set("scene lists a child", "/scenes/0/nodes", {0, 1, 2}, "expected root nodes");
  set("scene lists twice", "/scenes/0/nodes", {0, 0}, "expected each node once");
  set("asset version", "/asset/version", "1.0", "asset.version is '1.0', expected 2.x");
  set("asset minVersion", "/asset/minVersion", "2.9", "asset.minVersion");
  set("required extension", "/extensionsRequired", {"KHR_draco_mesh_compression"},
      "lists KHR_draco_mesh_compression, which is not supported");
  set("mode", "/meshes/0/primitives/0/mode", 7, "mode is 7");
  set("no primitives", "/meshes/0/primitives", json::array(), "expected a non-empty array");
  set("morph weights", "/meshes/0/weights", {0, 1}, "has 2 numbers, expected 1");
  set("node weights", "/nodes/0/weights", {0, 1}, "has 2 numbers, expected 1");
  set("animation path", "/animations/0/channels/0/target/path", "colour", "expected one of translation, rotation");
  set("rotation keys of the wrong width", "/animations/0/channels/0/target/path", "rotation",
      "is VEC3 of float, expected VEC4");
  set("cubic needs three values a key", "/animations/0/samplers/0/interpolation", "CUBICSPLINE",
      "expected 6 for 2 keys");
  set("joint missing", "/skins/0/joints", {1}, "uses joint 1, expected a joint below 1");
  set("roughness", "/materials/0/pbrMetallicRoughness/roughnessFactor", 1.5,
      "roughnessFactor is 1.5, expected a value of at least 0 and at most 1");
  set("alpha mode", "/materials/0/alphaMode", "GLASS", "expected one of OPAQUE, MASK, BLEND");
  set("third texture coordinates", "/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", 2, "expected 0 or 1");
  set("missing image file", "/images/0", {{"uri", "no%20such.png"}}, "no such.png does not exist");
  set("image without source", "/images/0", json::object(), "has neither uri nor bufferView");
  set("image in a bad view", "/images/0", {{"bufferView", 99}, {"mimeType", "image/png"}},
      "expected an index into bufferViews");
  set("image that is none", "/images/0", {{"bufferView", 0}, {"mimeType", "image/png"}}, "is not a PNG or JPEG image");
  set("remote buffer", "/buffers/0/uri", "https://example.com/a.bin", "expected a path relative to the file");
  set("missing buffer file", "/buffers/0/uri", "gone.bin", "gone.bin does not exist");
  set("broken base64", "/buffers/0/uri", "data:application/octet-stream;base64,AA!A", "not base64");
  set("buffer is a folder", "/buffers/0/uri", ".", "is not a regular file");
  set("camera", "/cameras/0/perspective/yfov", 4, "yfov is 4");
  set("light type", "/extensions/KHR_lights_punctual/lights/0/type", "laser",
      "expected one of point, spot, directional");
  set("nodes not an array", "/nodes", json::object(), "nodes is object, expected an array");
  set("far away", "/nodes/1/translation", {1e30, 0, 0}, "farther than 1e15");
  set("infinite transform", "/nodes/1/scale", {1e300, 1, 1}, "farther than 1e15");
  all.push_back({"cycle",
                 [](json& d) {
                   d["nodes"].push_back({{"children", {4}}});
                   d["nodes"].push_back({{"children", {3}}});
                 },
                 "expected a tree of nodes"});
  all.push_back({"joints without weights",
                 [](json& d) { d["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0"); },
                 "JOINTS_0 without WEIGHTS_0"});
  all.push_back({"skin on an unskinned mesh",
                 [](json& d) {
                   d["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
                   d["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
                 },
                 "has no JOINTS_0"});
  all.push_back({"no asset", [](json& d) { d.erase("asset"); }, "asset is missing"});
  all.push_back({"no positions at all",
                 [](json& d) { d["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); },
                 "contains no triangles"});
  all.push_back({"empty scene", [](json& d) { d["scenes"][0]["nodes"] = json::array(); }, "contains no triangles"});
  all.push_back({"same target twice",
                 [](json& d) { d["animations"][0]["channels"].push_back(d["animations"][0]["channels"][0]); },
                 "expected each property once"});
  return all;
}

TEST(Broken, EachBreakageGivesOneSentenceThatNamesTheElement) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "broken.gltf";
  folder.write("broken.gltf", rich_document().dump());
  ASSERT_EQ(verdict(file), "") << "the unbroken file loads";
  for (const Breakage& breakage : breakages()) {
    SCOPED_TRACE(breakage.name);
    json document = rich_document();
    breakage.apply(document);
    folder.write("broken.gltf", document.dump());
    const std::string sentence = verdict(file);
    EXPECT_THAT(sentence, HasSubstr(breakage.expected));
    EXPECT_THAT(sentence, HasSubstr("broken.gltf: "));
    EXPECT_EQ(sentence.find('\n'), std::string::npos);
  }
}

TEST(Broken, BadNumbersInBuffersAreErrors) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {nan, infinity, -infinity}) {
    GltfBuilder builder;
    builder.node(
        {{"mesh", builder.mesh({{"POSITION", builder.accessor<float>({0, 0, 0, 1, bad, 0, 0, 1, 0}, "VEC3")}})}});
    try {
      (void)builder.load();
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_THAT(
          error.what(),
          HasSubstr("meshes[0].primitives[0].attributes.POSITION holds a value that is not finite in element 1"));
    }
  }
  GltfBuilder builder;
  const int positions = builder.accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3");
  builder.node({{"mesh", builder.mesh({{"POSITION", positions}}, builder.accessor<uint16_t>({0, 1, 3}, "SCALAR"))}});
  try {
    (void)builder.load();
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_THAT(
        error.what(),
        HasSubstr("meshes[0].primitives[0].indices has 3 at place 2, expected a value below the vertex count 3"));
  }
  GltfBuilder clock;
  clock.animation(clock.node({{"mesh", clock.quad()}}), "translation", {0, 1, 1}, {0, 0, 0, 1, 0, 0, 2, 0, 0});
  EXPECT_THROW((void)clock.load(), Error);
}

TEST(Broken, IntegersWithAFractionOfZeroAreIntegers) {
  const TemporaryFolder folder;
  json document = rich_document();
  document["nodes"][0]["mesh"] = 0.0;
  document["accessors"][0]["count"] = 4.0;
  document["bufferViews"][1]["byteOffset"] = document["bufferViews"][1]["byteOffset"].get<double>();
  const Scene with_reals = load_scene(folder.write("reals.gltf", document.dump()));
  const Scene with_integers = load_scene(folder.write("integers.gltf", rich_document().dump()));
  ASSERT_EQ(with_reals.vertices.size(), with_integers.vertices.size());
  EXPECT_EQ(std::memcmp(with_reals.vertices.data(), with_integers.vertices.data(),
                        with_reals.vertices.size() * sizeof(Vertex)),
            0);
}

TEST(Broken, HugeCountsDoNotAllocate) {
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}});
  builder.append("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 2147483647}});
  builder.node({{"mesh", builder.mesh({{"POSITION", 4}})}});
  EXPECT_THROW((void)builder.load(), Error);
}

TEST(Broken, ManyInstancesOfALargeMeshDoNotAllocate) {
  GltfBuilder builder;
  builder.append("accessors", {{"componentType", 5126}, {"type", "VEC3"}, {"count", 3000000}});
  const int indices = builder.accessor<uint32_t>({0, 1, 2}, "SCALAR");
  builder.mesh({{"POSITION", 0}, {"NORMAL", 0}}, indices);
  builder.animation(builder.node({{"mesh", builder.quad()}}), "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
  for (int i = 0; i < 100; ++i) builder.node({{"mesh", 0}});
  // Degenerate triangles are dropped, so a scene that has only them is drawn from the quad alone.
  const Scene scene = builder.load();
  EXPECT_EQ(scene.triangles.size(), 2u);
}

TEST(Broken, DeepNestingAndLongChainsDoNotOverflow) {
  const TemporaryFolder folder;
  const std::string open(100000, '['), close(100000, ']');
  EXPECT_THAT(verdict(folder.write("deep.gltf", R"({"asset":{"version":"2.0"},"extras":)" + open + close + "}")),
              HasSubstr("the JSON has 201 levels, more than the limit of 200"));
  GltfBuilder builder;
  const int quad = builder.quad();
  for (int i = 0; i < 100000; ++i) builder.node(i < 99999 ? json{{"children", {i + 1}}} : json{{"mesh", quad}});
  const std::filesystem::path chain = folder.write("chain.gltf", builder.gltf());
  EXPECT_THAT(verdict(chain),
              HasSubstr("nodes[99999] with its ancestors has 100000 levels, more than the limit of 1000"));
  LoadOptions options;
  options.limits.node_depth = 100000;
  EXPECT_EQ(load_scene(chain, options).triangles.size(), 2u);
}

TEST(Broken, TruncatedFilesAreErrorsOrValid) {
  GltfBuilder builder;
  builder.animation(builder.node({{"mesh", builder.quad()}}), "translation", {0, 1}, {0, 0, 0, 1, 1, 1});
  const TemporaryFolder folder;
  for (const auto& [name, content] :
       {std::pair<std::string, std::string>{"t.gltf", builder.gltf()}, {"t.glb", builder.glb()}}) {
    ASSERT_EQ(verdict(folder.write(name, content)), "");
    for (size_t size = 0; size < content.size(); size += size < 64 ? 1 : 5) {
      EXPECT_NE(verdict(folder.write(name, content.substr(0, size))), "") << name << " cut after " << size;
    }
  }
}

TEST(Broken, TruncatedRealFilesAreErrorsOrValid) {
  LIGHTLOOM_NEED_SHARED(shared);
  const TemporaryFolder folder;
  for (const char* file :
       {"khronos/BoxAnimated/glTF-Binary/BoxAnimated.glb", "khronos/BoxAnimated/glTF-Embedded/BoxAnimated.gltf",
        "khronos/CesiumMan/glTF-Binary/CesiumMan.glb"}) {
    std::ifstream stream(shared / file, std::ios::binary);
    const std::string content((std::istreambuf_iterator<char>(stream)), {});
    const std::string name = "t" + std::filesystem::path(file).extension().string();
    for (int i = 0; i < 150; ++i) {
      const size_t size = content.size() * static_cast<size_t>(i) / 150;
      EXPECT_NE(verdict(folder.write(name, content.substr(0, size))), "") << file << " cut after " << size;
    }
  }
}

// Random damage: whatever comes out, it is an Error or a scene whose indices and numbers are sound.
TEST(Broken, RandomDamageNeverCrashes) {
  std::mt19937 random(11);
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.animation(builder.node({{"mesh", builder.quad()}}), "rotation", {0, 1}, {0, 0, 0, 1, 0, 1, 0, 0});
  const std::string glb = builder.glb(), text = rich_document().dump();
  int loaded = 0, refused = 0;
  for (int i = 0; i < 600; ++i) {
    const bool binary = i % 2 == 0;
    std::string content = binary ? glb : text;
    const int changes = 1 + static_cast<int>(random() % 3);
    for (int k = 0; k < changes; ++k) {
      char& target = content[random() % content.size()];
      target = binary ? static_cast<char>(random() & 255u) : "0123456789-.e[]{},:\""[random() % 20];
    }
    (verdict(folder.write(binary ? "d.glb" : "d.gltf", content)).empty() ? loaded : refused) += 1;
  }
  std::cout << "random damage: " << loaded << " loaded, " << refused << " refused\n";
  EXPECT_GT(refused, 200);
}

TEST(Broken, FilesWithSpacesAndPercentSignsLoad) {
  const TemporaryFolder folder;
  GltfBuilder builder;
  builder.node({{"mesh", builder.quad()}});
  json document = builder.finished();
  const std::string uri = document["buffers"][0]["uri"].get<std::string>();
  // The same bytes as the data URI, taken from the GLB's binary chunk.
  const std::string glb = builder.glb();
  const size_t start = glb.find(std::string("BIN\0", 4)) + 4;
  for (const auto& [name, reference] : {std::pair<std::string, std::string>{"my data.bin", "my%20data.bin"},
                                        {"my data.bin", "my data.bin"},
                                        {"50%25.bin", "50%25.bin"},
                                        {"r\xC3\xA9.bin", "r%C3%A9.bin"}}) {
    folder.write(name, glb.substr(start));
    document["buffers"][0]["uri"] = reference;
    EXPECT_EQ(verdict(folder.write("a file.gltf", document.dump())), "") << reference;
  }
  EXPECT_FALSE(uri.empty());
}

}  // namespace
}  // namespace lightloom::scene
