#pragma once

#include <string>

#include "framework/study/bench_record.hpp"

namespace lightloom::cli {

/// The figures as tables for a person.
[[nodiscard]] std::string bench_report(const study::BenchRecord& record);

}  // namespace lightloom::cli
