#include "framework/stability/check.hpp"

namespace lightloom::stability {

std::vector<Check> all_checks() {
  std::vector<Check> checks;
  add_random_checks(checks);
  return checks;
}

}  // namespace lightloom::stability
