#pragma once

#include <string>

namespace lightloom::run {

[[nodiscard]] std::string version();  ///< "0.1.0"
/// Commit of the source tree at build time, "-dirty" appended where files differed; "unknown" outside a checkout.
[[nodiscard]] std::string commit();

}  // namespace lightloom::run
