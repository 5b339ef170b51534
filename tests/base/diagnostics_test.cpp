#include "framework/base/diagnostics.hpp"

#include <gtest/gtest.h>

namespace lightloom {
namespace {

TEST(Diagnostics, SortsByPlaceAndKeepsOrderOfEquals) {
  Diagnostics diagnostics;
  diagnostics.error("c", {"b.json", 1, 1}, "third");
  diagnostics.error("a", {"a.json", 10, 1}, "second a");
  diagnostics.warning("b", {"a.json", 10, 1}, "second b");
  diagnostics.error("d", {"a.json", 9, 80}, "first");
  const auto sorted = diagnostics.sorted();
  ASSERT_EQ(sorted.size(), 4U);
  EXPECT_EQ(sorted[0].message, "first");
  EXPECT_EQ(sorted[1].message, "second a");
  EXPECT_EQ(sorted[2].message, "second b");
  EXPECT_EQ(sorted[3].message, "third");
}

TEST(Diagnostics, WarningsAreNoErrors) {
  Diagnostics diagnostics;
  diagnostics.warning("w", {}, "odd");
  EXPECT_FALSE(diagnostics.has_errors());
  diagnostics.error("e", {}, "wrong");
  EXPECT_TRUE(diagnostics.has_errors());
}

TEST(Diagnostics, Format) {
  EXPECT_EQ(format_diagnostic({"cycle", Severity::error, {"g.json", 3, 7}, "it turns", "use @1"}),
            "g.json:3:7: error[cycle]: it turns\n  hint: use @1");
  EXPECT_EQ(format_diagnostic({"no-match", Severity::warning, {"--set", 0, 0}, "nothing", ""}),
            "--set: warning[no-match]: nothing");
  EXPECT_EQ(format_diagnostic({"x", Severity::note, {}, "nowhere", ""}), "note[x]: nowhere");
}

}  // namespace
}  // namespace lightloom
