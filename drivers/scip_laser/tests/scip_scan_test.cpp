// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/scip_scan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "dialogue.hpp"

namespace rave::scip {
namespace {

ScanRequest request(std::int32_t last_step, bool continuous = true, std::int32_t characters = 3) {
  ScanRequest request;
  request.continuous = continuous;
  request.characters = characters;
  request.last_step = last_step;
  request.range_min_mm = 20;
  request.range_max_mm = 5600;
  return request;
}

/// The end of reading the last reply of some bytes.
ScanEnd read(const std::string& bytes, const ScanRequest& wanted, Scan& scan) {
  ScipDecoder decoder;
  ScanEnd end = ScanEnd::kNoScan;
  for (const char byte : bytes) {
    const Reply* reply = decoder.push(byte);
    if (reply != nullptr) end = read_scan(*reply, wanted, scan);
  }
  return end;
}

TEST(Scan, CommandsAsTheSpecificationHasThem) {
  ScanRequest wanted = request(725);
  wanted.first_step = 44;
  EXPECT_EQ(wanted.command(), "MD0044072501000");
  wanted.skipped_scans = 3;
  wanted.characters = 2;
  EXPECT_EQ(wanted.command(), "MS0044072501300");
  wanted.continuous = false;
  EXPECT_EQ(wanted.command(), "GS0044072501");
}

TEST(Scan, RangesInMetresAndWhatLiesBeyondAsNoReturn) {
  const std::vector<unsigned> mm = {5602, 65'533, 20, 1234, 5600, 5601, 262'143};
  Scan scan;
  for (const bool continuous : {true, false}) {
    const ScanRequest wanted = request(6, continuous);
    const std::string text = scan_text(wanted.command(), continuous ? "99" : "00", 0xabcdef, mm, 3);
    ASSERT_EQ(read(text, wanted, scan), ScanEnd::kScan);
    EXPECT_EQ(scan.timer_ms, 0xabcdefU);
    ASSERT_EQ(scan.ranges_m.size(), 7U);
    for (const std::size_t none : {0U, 1U, 5U, 6U}) EXPECT_TRUE(std::isinf(scan.ranges_m[none]));
    EXPECT_FLOAT_EQ(scan.ranges_m[2], 0.020F);
    EXPECT_FLOAT_EQ(scan.ranges_m[3], 1.234F);
    EXPECT_FLOAT_EQ(scan.ranges_m[4], 5.600F);
  }
}

TEST(Scan, TheLargestNumberOfTwoCharactersIsNoReturn) {
  for (const bool continuous : {true, false}) {
    ScanRequest wanted = request(2, continuous, 2);
    const std::string text =
        scan_text(wanted.command(), continuous ? "99" : "00", 1, {4093, 4094, 4095}, 2);
    Scan scan;
    ASSERT_EQ(read(text, wanted, scan), ScanEnd::kScan);
    EXPECT_FLOAT_EQ(scan.ranges_m[0], 4.093F);
    EXPECT_FLOAT_EQ(scan.ranges_m[1], 4.094F);
    EXPECT_TRUE(std::isinf(scan.ranges_m[2])) << "a wall at 4.095 m that is not there";
  }
}

TEST(Scan, ErrorCodesAsTheModelMeansThem) {
  const std::vector<unsigned> mm = {0, 1, 2, 3, 6, 7, 19, 20, 22, 23};
  ScanRequest wanted = request(9);
  wanted.range_min_mm = 23;  // as a UTM-30LX has it
  Scan scan;
  for (const ErrorCodes codes : {ErrorCodes::kReasons, ErrorCodes::kDistances}) {
    wanted.codes = codes;
    ASSERT_EQ(read(scan_text(wanted.command(), "99", 1, mm, 3), wanted, scan), ScanEnd::kScan);
    for (const std::size_t unknown : {0U, 3U, 4U, 5U, 6U}) {
      EXPECT_TRUE(std::isnan(scan.ranges_m[unknown])) << mm[unknown];
    }
    for (const std::size_t near : {7U, 8U, 9U}) EXPECT_FLOAT_EQ(scan.ranges_m[near], 0.023F);
    const bool older = codes == ErrorCodes::kReasons;
    EXPECT_EQ(std::isnan(scan.ranges_m[1]), older);
    EXPECT_EQ(std::isinf(scan.ranges_m[1]), !older);
    EXPECT_EQ(std::isnan(scan.ranges_m[2]), older);
    if (!older) {
      EXPECT_FLOAT_EQ(scan.ranges_m[2], 0.023F);
    }
  }
}

TEST(Scan, SeesIfAnyRayWasMeasured) {
  ScanRequest wanted = request(2);
  wanted.codes = ErrorCodes::kReasons;
  Scan scan;
  const auto read_all = [&](const std::vector<unsigned>& mm) {
    EXPECT_EQ(read(scan_text(wanted.command(), "99", 1, mm, 3), wanted, scan), ScanEnd::kScan);
    return scan.sees();
  };
  EXPECT_FALSE(read_all({0, 7, 19}));
  EXPECT_TRUE(read_all({0, 700, 19}));
  EXPECT_TRUE(read_all({0, 5601, 19})) << "free space was measured";
}

TEST(Scan, OfThreeCharacters4095IsARange) {
  const ScanRequest wanted = request(0);
  Scan scan;
  ASSERT_EQ(read(scan_text(wanted.command(), "99", 1, {4095}, 3), wanted, scan), ScanEnd::kScan);
  EXPECT_FLOAT_EQ(scan.ranges_m[0], 4.095F);
}

TEST(Scan, RangesAcrossTheEndOfABlock) {
  std::vector<unsigned> mm;
  for (unsigned i = 0; i < 682; ++i) mm.push_back(1000 + 7 * i % 4000);
  for (const int characters : {2, 3}) {
    const ScanRequest wanted = request(681, true, characters);
    if (characters == 2) {
      for (unsigned& value : mm) value = std::max(value % 4096, 20U);
    }
    Scan scan;
    ASSERT_EQ(read(scan_text(wanted.command(), "99", 1, mm, characters), wanted, scan),
              ScanEnd::kScan);
    ASSERT_EQ(scan.ranges_m.size(), 682U);
    for (std::size_t i = 0; i < mm.size(); ++i) {
      const bool none = mm[i] < 20 || mm[i] > 5600;
      EXPECT_EQ(std::isinf(scan.ranges_m[i]), none) << i;
      if (!none) {
        EXPECT_FLOAT_EQ(scan.ranges_m[i], static_cast<float>(mm[i]) / 1000) << i;
      }
    }
  }
}

TEST(Scan, OnlyAWholeOneIsTaken) {
  const std::vector<unsigned> mm(100, 3000);
  const ScanRequest wanted = request(99);
  const std::string whole = scan_text(wanted.command(), "99", 1, mm, 3);
  Scan scan;
  ASSERT_EQ(read(whole, wanted, scan), ScanEnd::kScan);
  // Lines lost, doubled or too many: each line by itself is right.
  const std::size_t block = whole.find('\n', whole.find("99b") + 4) + 1;  // behind the timer
  std::string text = whole;
  EXPECT_EQ(read(text.erase(block, 66), wanted, scan), ScanEnd::kMalformed);
  text = whole;
  EXPECT_EQ(read(text.insert(block, whole.substr(block, 66)), wanted, scan), ScanEnd::kMalformed);
  EXPECT_EQ(
      read(scan_text(wanted.command(), "99", 1, std::vector<unsigned>(101, 3000), 3), wanted, scan),
      ScanEnd::kMalformed);
  EXPECT_EQ(read(wanted.command() + "\n99b\n\n", wanted, scan), ScanEnd::kMalformed);
  // A character outside the code with a checksum that fits.
  text = wanted.command() + "\n99b\n" + with_sum("0001");
  text += with_sum(std::string(64, 'p')) + with_sum(std::string(64, '0'));
  text += with_sum(std::string(64, '0')) + with_sum(std::string(64, '0'));
  text += with_sum(std::string(44, '0')) + "\n";
  EXPECT_EQ(read(text, wanted, scan), ScanEnd::kMalformed);
}

TEST(Scan, OtherRepliesAreNone) {
  Scan scan;
  const ScanRequest wanted = request(9);
  EXPECT_EQ(read("QT\n00P\n\n", wanted, scan), ScanEnd::kNoScan);
  EXPECT_EQ(read(wanted.command() + "\n00P\n\n", wanted, scan), ScanEnd::kNoScan);
  EXPECT_EQ(read(wanted.command() + "\n0Dd\n\n", wanted, scan), ScanEnd::kRefused);
  const std::vector<unsigned> mm(10, 3000);
  EXPECT_EQ(read(scan_text("MD0000001001000", "99", 1, mm, 3), wanted, scan), ScanEnd::kNoScan);
}

TEST(Scan, StatusesInWords) {
  EXPECT_EQ(describe_status("10"), "status 10 (the laser is off)");
  EXPECT_EQ(describe_status("55"), "status 55 (hardware trouble)");
  EXPECT_EQ(describe_status("0E"), "status 0E (unknown command or parameter)");
  EXPECT_EQ(describe_status("04"), "status 04 (a parameter of the command is wrong)");
}

}  // namespace
}  // namespace rave::scip
