#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

// Many textures with colour profiles are read at the same time. OpenImageIO 2.4 crashed in about a quarter of all
// starts: it fills a table without a lock when it meets its first profiles, so that only a new process can show it.
namespace lightloom::cli {
namespace {

constexpr int kTextures = 12;

void put(std::vector<uint8_t>& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

void put(std::vector<uint8_t>& bytes, uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<uint8_t>(value >> shift));
}

struct ProfileTag {
  std::string_view name, type, value;
};

/// A profile of a display with what usual ones tell (ICC.1:2001-04, sections 6.1 and 6.2).
std::vector<uint8_t> make_profile() {
  const std::initializer_list<ProfileTag> tags = {
      {"cprt", "text", "nobody"}, {"desc", "desc", ""},    {"wtpt", "XYZ ", ""}, {"bkpt", "XYZ ", ""},
      {"rXYZ", "XYZ ", ""},       {"gXYZ", "XYZ ", ""},    {"bXYZ", "XYZ ", ""}, {"dmnd", "desc", ""},
      {"dmdd", "desc", ""},       {"vued", "desc", ""},    {"view", "view", ""}, {"lumi", "XYZ ", ""},
      {"meas", "meas", ""},       {"tech", "sig ", "CRT "}};
  constexpr uint32_t kTagBytes = 100;
  const auto first = static_cast<uint32_t>(132 + 12 * tags.size());
  std::vector<uint8_t> profile;
  put(profile, static_cast<uint32_t>(first + kTagBytes * tags.size()));
  put(profile, "Lino");
  put(profile, 0x02100000u);
  put(profile, "mntrRGB XYZ ");
  for (int i = 0; i < 3; ++i) put(profile, 0x07ce0002u);
  put(profile, "acspMSFT");
  put(profile, 0u);
  put(profile, "IEC sRGB");
  profile.resize(128);
  put(profile, static_cast<uint32_t>(tags.size()));
  uint32_t offset = first;
  for (const ProfileTag& tag : tags) {
    put(profile, tag.name);
    put(profile, offset);
    put(profile, kTagBytes);
    offset += kTagBytes;
  }
  for (const ProfileTag& tag : tags) {
    const size_t start = profile.size();
    put(profile, tag.type);
    put(profile, 0u);
    put(profile, tag.value);
    profile.resize(start + kTagBytes);
  }
  return profile;
}

void write_jpeg(const std::filesystem::path& file) {
  OIIO::ImageSpec spec(8, 8, 3, OIIO::TypeDesc::UINT8);
  const std::vector<uint8_t> profile = make_profile();
  spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(profile.size())), profile.data());
  const auto output = OIIO::ImageOutput::create("jpeg");
  const std::vector<uint8_t> samples(8 * 8 * 3, 128);
  ASSERT_TRUE(output->open(file.string(), spec) && output->write_image(OIIO::TypeDesc::UINT8, samples.data()));
}

/// One triangle for each texture.
void write_scene(const std::filesystem::path& folder) {
  std::string images, textures, materials, meshes, nodes, listed;
  for (int i = 0; i < kTextures; ++i) {
    const std::string n = std::to_string(i), comma = i == 0 ? "" : ",";
    write_jpeg(folder / (n + ".jpg"));
    images += comma + R"({"uri":")" + n + R"(.jpg"})";
    textures += comma + R"({"source":)" + n + "}";
    materials += comma + R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":)" + n + "}}}";
    meshes += comma + R"({"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":)" + n + "}]}";
    nodes += comma + R"({"mesh":)" + n + "}";
    listed += comma + n;
  }
  const float corners[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
  std::ofstream(folder / "data.bin", std::ios::binary).write(reinterpret_cast<const char*>(corners), sizeof corners);
  std::ofstream(folder / "scene.gltf")
      << R"({"asset":{"version":"2.0"},"buffers":[{"uri":"data.bin","byteLength":60}],"bufferViews":[)"
      << R"({"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],"accessors":[)"
      << R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
      << R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}],"images":[)" << images << R"(],"textures":[)"
      << textures << R"(],"materials":[)" << materials << R"(],"meshes":[)" << meshes << R"(],"nodes":[)" << nodes
      << R"(],"scenes":[{"nodes":[)" << listed << R"(]}],"scene":0})";
}

TEST(ColourProfiles, ReadInSeveralThreadsDoNotCrashTheProgram) {
  std::string name = (std::filesystem::temp_directory_path() / "lightloom_profiles_XXXXXX").string();
  ASSERT_NE(mkdtemp(name.data()), nullptr);
  const std::filesystem::path folder = name;
  write_scene(folder);
  const std::string command = std::string(LIGHTLOOM_PROGRAM) + " scene " + (folder / "scene.gltf").string() + " >" +
                              (folder / "log").string() + " 2>&1";
  int failed = 0;
  for (int start = 0; start < 25; ++start) failed += std::system(command.c_str()) == 0 ? 0 : 1;
  std::string said;
  std::getline(std::ifstream(folder / "log"), said, '\0');
  EXPECT_EQ(failed, 0) << said;
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
}

}  // namespace
}  // namespace lightloom::cli
