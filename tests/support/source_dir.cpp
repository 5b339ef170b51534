#include "tests/support/source_dir.hpp"

namespace lightloom {

std::filesystem::path source_dir() {
  return LIGHTLOOM_SOURCE_DIR;
}

}  // namespace lightloom
