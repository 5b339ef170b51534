#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "framework/base/file.hpp"
#include "framework/base/text.hpp"
#include "tests/support/source_dir.hpp"

namespace lightloom::test {

/// A folder of this process that goes when the object does.
class SchemaFolder {
 public:
  SchemaFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "lightloom-schema-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  SchemaFolder(const SchemaFolder&) = delete;
  SchemaFolder& operator=(const SchemaFolder&) = delete;
  ~SchemaFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }

  /// What Python's validator says of each file: "yes", "no" or "no JSON". Throws where it cannot be run, or the schema
  /// is none.
  std::vector<std::string> check(const std::filesystem::path& schema,
                                 const std::vector<std::filesystem::path>& files) const {
    std::string arguments = " '" + schema.string() + "'";
    for (const std::filesystem::path& file : files) arguments += " '" + file.string() + "'";
    const std::filesystem::path script = source_dir() / "tests/support/schema_check.py";
    const std::filesystem::path answers = path_ / "answers.txt";
    const std::string command = "python3 '" + script.string() + "'" + arguments + " > '" + answers.string() + "'";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("python3 with jsonschema failed");
    std::vector<std::string> lines = split(read_text_file(answers), '\n');
    lines.pop_back();
    if (lines.size() != files.size()) throw std::runtime_error("the validator does not answer for each file");
    return lines;
  }

 private:
  std::filesystem::path path_;
};

}  // namespace lightloom::test
