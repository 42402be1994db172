// SPDX-License-Identifier: Apache-2.0
#include "recording/unpack.hpp"

#include <gtest/gtest.h>

#include "rave/player_testing/pack.hpp"

namespace rave::recording {
namespace {

constexpr std::size_t kPlenty = 1 << 20;

std::string long_text() {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += std::to_string(i * 7919) + "\n";
  return text;
}

TEST(Unpack, TakesPlainTextAndGzipOfOneOrMoreMembers) {
  EXPECT_EQ(unpack_text("plain\n", "f", kPlenty)->text, "plain\n");
  const std::string text = long_text();
  EXPECT_EQ(unpack_text(pack(text), "f", kPlenty)->text, text);
  const auto two = unpack_text(pack(text) + pack("more\n"), "f", kPlenty);
  EXPECT_EQ(two->text, text + "more\n");
  EXPECT_FALSE(two->cut);
}

TEST(Unpack, SaysThatAStreamWasCutWhereverItWasCut) {
  const std::string text = long_text();
  const std::string packed = pack(text);
  for (const std::size_t size :
       {std::size_t{2}, std::size_t{10}, packed.size() / 2, packed.size() - 8, packed.size() - 1}) {
    const auto cut = unpack_text(packed.substr(0, size), "f", kPlenty);
    ASSERT_TRUE(cut) << size << ": " << cut.error().text();
    EXPECT_TRUE(cut->cut) << size;
    EXPECT_TRUE(text.starts_with(cut->text)) << size;
  }
}

TEST(Unpack, RefusesDamage) {
  std::string packed = pack(long_text());
  packed[packed.size() - 6] ^= 1;  // in the checksum
  EXPECT_EQ(unpack_text(packed, "a.gz", kPlenty).error().text(),
            "a.gz: the gzip data are damaged (incorrect data check); fetch the file again");
  EXPECT_EQ(unpack_text(pack("x") + "tail", "a.gz", kPlenty).error().text(),
            "a.gz: 4 bytes follow the end of the gzip stream");
}

TEST(Unpack, RefusesMoreThanTheLimit) {
  const std::string bomb = pack(std::string(kPlenty + 1, '0'));
  EXPECT_LT(bomb.size(), kPlenty / 100);
  EXPECT_EQ(unpack_text(bomb, "a.gz", kPlenty).error().text(),
            "a.gz: the unpacked log is larger than 1048576 bytes");
  EXPECT_EQ(unpack_text("12345", "a", 4).error().text(),
            "a: the unpacked log is larger than 4 bytes");
}

TEST(Unpack, DigestIsSha256) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace rave::recording
