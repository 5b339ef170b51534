#include "framework/base/hash.hpp"

#include <gtest/gtest.h>

namespace lightloom {
namespace {

// Test vectors of RFC 9923 (FNV), 64 bits.
TEST(Hash, PublishedVectors) {
  EXPECT_EQ(hash_text(""), 0xcbf29ce484222325ULL);
  EXPECT_EQ(hash_text("a"), 0xaf63dc4c8601ec8cULL);
  EXPECT_EQ(hash_text("foobar"), 0x85944171f73967e8ULL);
}

TEST(Hash, TextsAreSeparated) {
  Hasher a;
  a.text("ab");
  a.text("c");
  Hasher b;
  b.text("a");
  b.text("bc");
  EXPECT_NE(a.value(), b.value());
}

TEST(Hash, NumbersAreLittleEndianBytes) {
  Hasher number;
  number.number(0x0807060504030201ULL);
  const unsigned char bytes[] = {1, 2, 3, 4, 5, 6, 7, 8};
  EXPECT_EQ(number.value(), hash_bytes(bytes, sizeof bytes));
}

TEST(Hash, HexHasSixteenDigits) {
  EXPECT_EQ(hex(0), "0000000000000000");
  EXPECT_EQ(hex(0x0123456789abcdefULL), "0123456789abcdef");
}

}  // namespace
}  // namespace lightloom
