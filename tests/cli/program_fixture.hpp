#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "framework/cli/program.hpp"
#include "passes/registry.hpp"

namespace lightloom::cli {

/// The program in this process, its output caught, and a folder that goes away with the test.
class ProgramTest : public ::testing::Test {
 protected:
  /// `command` comes before the arguments of every run.
  explicit ProgramTest(std::vector<std::string> command = {}) : command_(std::move(command)) {
    passes::register_builtin_passes(registry_);
    std::string name = (std::filesystem::temp_directory_path() / "lightloom_program_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  ~ProgramTest() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  /// Returns the exit code.
  int run(const std::vector<std::string>& arguments) {
    std::vector<std::string> whole = command_;
    whole.insert(whole.end(), arguments.begin(), arguments.end());
    std::ostringstream out;
    std::ostringstream err;
    const CommandContext context{out, err, false, registry_};
    const ExitCode code = run_program(whole, context);
    out_ = out.str();
    err_ = err.str();
    return static_cast<int>(code);
  }

  std::vector<std::string> command_;
  PassRegistry registry_;
  std::filesystem::path folder_;
  std::string out_;
  std::string err_;
};

}  // namespace lightloom::cli
