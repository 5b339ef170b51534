#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "framework/base/error.hpp"
#include "framework/scene/scene.hpp"
#include "tests/scene/gltf_builder.hpp"
#include "tests/support/peak_memory.hpp"

// Broken and odd files that others collected, with what the reference validator of glTF says about them.

namespace lightloom::scene {
namespace {

using nlohmann::json;

std::string verdict(const std::filesystem::path& file) {
  try {
    (void)load_scene(file);
    return "";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::invalid_input);
    return error.what();
  }
}

/// One error of the validator: its code, and the element as our sentences name it ("accessors[0]"; "" for the whole).
struct Finding {
  std::string code;
  std::string element;
};

/// "/bufferViews/0/byteStride" to "bufferViews[0]", "/scene" to "scene".
std::string element_of(const std::string& pointer) {
  std::string element;
  int parts = 0;
  size_t begin = 1;
  while (begin < pointer.size() && parts < 2) {
    const size_t end = std::min(pointer.find('/', begin), pointer.size());
    const std::string part = pointer.substr(begin, end - begin);
    const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
    if (parts == 1 && !number) break;
    element += number ? "[" + part + "]" : part;
    begin = end + 1;
    ++parts;
  }
  return element;
}

/// The errors (severity 0) of the report beside a file; nothing if there is no report.
std::optional<std::vector<Finding>> validator_errors(const std::filesystem::path& file) {
  for (const std::string& name :
       {file.string() + ".report.json", (file.parent_path() / file.stem()).string() + ".report.json"}) {
    std::ifstream stream(name);
    if (!stream) continue;
    std::vector<Finding> findings;
    const json report = json::parse(stream);
    for (const json& message : report["issues"].value("messages", json::array()))
      if (message["severity"] == 0)
        findings.push_back({message["code"].get<std::string>(), element_of(message.value("pointer", ""))});
    return findings;
  }
  return std::nullopt;
}

/// Errors of the validator that do no harm here, so that such a file may load or be refused for something else.
const std::map<std::string, std::string> kTolerated = {
    {"EMPTY_ENTITY", "exporters write empty arrays, which say the same as none"},
    {"BUFFER_DATA_URI_MIME_TYPE_INVALID", "the content of a data URI is the same whatever type it is said to have"},
};

/// Files whose JSON begins with a byte order mark, which glTF forbids to write, while readers may ignore it.
const std::set<std::string> kToleratedFiles = {"bom.glb", "bom.gltf"};

/// Files without errors that are refused all the same, by what their sentences say.
const std::vector<std::string> kNothingToDraw = {
    "contains no triangles",                               // most of the validator's files have no mesh
    "expected a path relative to the file or a data URI",  // http: is not fetched
    "there is no GLB binary chunk for it",                 // a placeholder for a buffer that somebody else provides
    "asset.minVersion is '2.1', expected 2.0",             // there is no glTF 2.1 yet
    R"(type is "NotaVEC3", expected one of)",  // only a warning of the validator, as it may be an extension's
};

class Collected : public ::testing::Test {
 protected:
  void check(const std::filesystem::path& file) {
    SCOPED_TRACE(file.string());
    const ::lightloom::test::Usage usage;
    const std::string sentence = verdict(file);
    EXPECT_LT(usage.seconds(), 1.0);
    EXPECT_LT(usage.megabytes(), 1024u);
    most_megabytes_ = std::max(most_megabytes_, usage.megabytes());
    most_seconds_ = std::max(most_seconds_, usage.seconds());
    ++(sentence.empty() ? loaded_ : refused_);
    const auto findings = validator_errors(file);
    if (findings && findings->empty()) check_valid(sentence);
    if (findings && !findings->empty() && !kToleratedFiles.contains(file.filename()))
      check_invalid(*findings, sentence);
  }

  static void check_valid(const std::string& sentence) {
    const bool known = std::any_of(kNothingToDraw.begin(), kNothingToDraw.end(), [&](const std::string& reason) {
      return sentence.find(reason) != std::string::npos;
    });
    EXPECT_TRUE(sentence.empty() || known) << "the validator finds no error, but: " << sentence;
  }

  static void check_invalid(const std::vector<Finding>& findings, const std::string& sentence) {
    std::string codes;
    bool harmful = false, named = false;
    for (const Finding& finding : findings) {
      codes += " " + finding.code + "(" + finding.element + ")";
      if (kTolerated.contains(finding.code)) continue;
      harmful = true;
      named = named || sentence.find(finding.element) != std::string::npos;
    }
    if (!harmful) return;
    EXPECT_FALSE(sentence.empty()) << "was taken silently:" << codes;
    EXPECT_EQ(sentence.find("contains no triangles"), std::string::npos) << "what is wrong was not noticed:" << codes;
    EXPECT_TRUE(named) << sentence << "\ndoes not name the element of" << codes;
  }

  int loaded_ = 0, refused_ = 0;
  uint64_t most_megabytes_ = 0;
  double most_seconds_ = 0;
};

TEST_F(Collected, EveryFileGetsTheValidatorsVerdict) {
  LIGHTLOOM_NEED_SHARED(shared);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared / "broken")) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".gltf" || extension == ".glb") check(entry.path());
  }
  std::cout << loaded_ << " files load, " << refused_ << " are refused; at most " << most_megabytes_ << " MiB and "
            << most_seconds_ << " s\n";
  EXPECT_GT(loaded_ + refused_, 50);
}

}  // namespace
}  // namespace lightloom::scene
