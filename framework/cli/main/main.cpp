#include <iostream>
#include <string>
#include <vector>

#include "framework/base/progress.hpp"
#include "framework/cli/program.hpp"
#include "passes/registry.hpp"

int main(int argc, char** argv) {
  lightloom::PassRegistry registry;
  lightloom::passes::register_builtin_passes(registry);
  const lightloom::cli::CommandContext context{std::cout, std::cerr, lightloom::standard_error_is_terminal(), registry};
  return static_cast<int>(lightloom::cli::run_program({argv + 1, argv + argc}, context));
}
