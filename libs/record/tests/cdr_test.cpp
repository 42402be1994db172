// SPDX-License-Identifier: Apache-2.0
#include "rave/record/cdr.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "crc32.hpp"
#include "same_bits.hpp"
#include "temporary_file.hpp"

namespace rave::record {
namespace {

std::string hex(std::span<const std::byte> bytes) {
  std::string text;
  for (const std::byte byte : bytes) text += fmt::format("{:02x}", static_cast<unsigned>(byte));
  return text;
}

TEST(Cdr, AlignsFromBehindTheHeader) {
  CdrWriter writer;
  writer.put(std::uint8_t{1});
  writer.put(std::uint16_t{0x0203});
  writer.put(std::uint32_t{4});
  writer.put(1.0);
  EXPECT_EQ(hex(writer.bytes()),
            "00010000"
            "01"
            "00"
            "0302"
            "04000000"
            "000000000000f03f");
}

TEST(Cdr, StringsEndWithAZeroThatIsCounted) {
  CdrWriter writer;
  writer.put_string("abc");
  writer.put_string("");
  writer.put(std::uint32_t{9});
  EXPECT_EQ(hex(writer.bytes()),
            "00010000"
            "04000000"
            "61626300"
            "01000000"
            "00"
            "000000"
            "09000000");
}

TEST(Cdr, AnEmptySequenceHasNoPadding) {
  CdrWriter writer;
  writer.put_sequence(std::span<const double>());
  writer.put(std::uint32_t{7});
  EXPECT_EQ(hex(writer.bytes()),
            "00010000"
            "00000000"
            "07000000");
}

TEST(Cdr, ReadsBackWhatWasWritten) {
  const std::vector<double> numbers = {-0.0, std::numeric_limits<double>::denorm_min(), 1.0 / 3};
  CdrWriter writer;
  writer.put(std::uint8_t{5});
  writer.put_sequence(std::span<const double>(numbers));
  writer.put_string("é");
  writer.put(std::int64_t{-2});
  CdrReader reader(writer.bytes());
  EXPECT_EQ(reader.get<std::uint8_t>(), 5);
  const auto read = reader.get_sequence<double>();
  ASSERT_EQ(read.size(), 3U);
  EXPECT_TRUE(same_bits(read.data(), numbers.data(), 24));
  EXPECT_EQ(reader.get_string(), "é");
  EXPECT_EQ(reader.get<std::int64_t>(), -2);
  EXPECT_TRUE(reader.ok());
  static_cast<void>(reader.get<std::uint8_t>());
  EXPECT_FALSE(reader.ok());
}

TEST(Cdr, RefusesBigEndianAndLyingCounts) {
  const std::byte big[] = {std::byte{0}, std::byte{0}, std::byte{0}, std::byte{0}};
  EXPECT_FALSE(CdrReader(big).ok());
  CdrWriter writer;
  writer.put_count(0xFFFFFFFF);
  CdrReader sequence(writer.bytes());
  EXPECT_TRUE(sequence.get_sequence<double>().empty());
  EXPECT_FALSE(sequence.ok());
  CdrReader count(writer.bytes());
  EXPECT_EQ(count.get_count(1), 0U);
  EXPECT_FALSE(count.ok());
}

TEST(Crc32, MatchesTheKnownValueInOneAndInSeveralPieces) {
  EXPECT_EQ(crc32(bytes_of("123456789")), 0xCBF43926U);
  std::string text;
  for (int i = 0; i < 1000; ++i) text += static_cast<char>(i * 7);
  const auto bytes = bytes_of(text);
  for (std::size_t cut = 0; cut <= 40; ++cut) {
    EXPECT_EQ(crc32(bytes.subspan(cut), crc32(bytes.first(cut))), crc32(bytes));
  }
}

}  // namespace
}  // namespace rave::record
