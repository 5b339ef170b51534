#pragma once

#include <string>
#include <vector>

namespace lightloom::cli {

/// A file of a skeleton.
struct NewFile {
  std::string name;  ///< relative to its folder
  std::string text;
};

/// A plug-in project with one pass type `name`: CMakeLists.txt, C++, shader, a graph that uses it, and what to do next.
[[nodiscard]] std::vector<NewFile> new_plugin_files(const std::string& name);

/// A pass of type `compute`: a shader, and a graph that uses it.
[[nodiscard]] std::vector<NewFile> new_compute_files(const std::string& name);

}  // namespace lightloom::cli
