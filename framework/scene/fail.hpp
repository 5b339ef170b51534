#pragma once

#include <string>

#include "framework/base/error.hpp"

namespace lightloom::scene {

/// Throws Error(invalid_input) with the sentence "FILE: ELEMENT WHAT".
[[noreturn]] inline void fail(const std::string& file, const std::string& element, const std::string& what,
                              std::string hint = {}) {
  throw Error(ExitCode::invalid_input, file + ": " + element + " " + what, std::move(hint));
}

}  // namespace lightloom::scene
