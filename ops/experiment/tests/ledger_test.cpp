// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/ledger.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "rave/base/file.hpp"

namespace rave::experiment {
namespace {

RunRow sample(std::uint64_t seed) {
  return {"0123456789abcdef", seed, "", {0.1, std::nullopt, -3}, 60.5, "00ff", 0.25};
}

class LedgerFile : public testing::Test {
 protected:
  void SetUp() override {
    char name[] = "/tmp/rave-ledger-XXXXXX";
    folder_ = ::mkdtemp(name);
    path_ = folder_ / "ledger.jsonl";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path folder_;
  std::filesystem::path path_;
};

TEST_F(LedgerFile, GivesBackWhatWasAdded) {
  RunRow failed = sample(2);
  failed.failure = "no \"end\"\nwithin 1 s";
  failed.values.clear();
  {
    auto ledger = Ledger::open(path_);
    ASSERT_TRUE(ledger.has_value());
    EXPECT_TRUE(ledger->append(sample(1)));
    EXPECT_TRUE(ledger->append(failed));
  }
  const auto rows = RunRows::read(folder_);
  ASSERT_TRUE(rows.has_value());
  EXPECT_EQ(rows->size(), 2U);
  ASSERT_NE(rows->find("0123456789abcdef", 1), nullptr);
  EXPECT_EQ(*rows->find("0123456789abcdef", 1), sample(1));
  EXPECT_EQ(*rows->find("0123456789abcdef", 2), failed);
  EXPECT_EQ(rows->find("0123456789abcdee", 1), nullptr);
}

TEST_F(LedgerFile, EndsAtWhateverByteItWasCutOff) {
  const std::string line = write_row(sample(1)) + "\n";
  const std::string both = line + write_row(sample(2)) + "\n";
  for (std::size_t length = 0; length <= both.size(); ++length) {
    std::ofstream(path_, std::ios::trunc) << both.substr(0, length);
    {
      auto ledger = Ledger::open(path_);
      ASSERT_TRUE(ledger.has_value());
      EXPECT_TRUE(ledger->append(sample(3)));
    }
    const auto rows = RunRows::read(folder_);
    ASSERT_TRUE(rows.has_value());
    const std::size_t whole = (length >= line.size() ? 1U : 0U) + (length == both.size() ? 1U : 0U);
    EXPECT_EQ(rows->size(), whole + 1) << length;
    EXPECT_EQ(rows->unreadable(), 0U) << length;
  }
}

TEST_F(LedgerFile, CountsLinesThatAreNoRows) {
  std::ofstream(path_) << write_row(sample(1)) << "\n{\"inputs\":3}\n\n"
                       << write_row(sample(2)) << "\n";
  const auto rows = RunRows::read(folder_);
  ASSERT_TRUE(rows.has_value());
  EXPECT_EQ(rows->size(), 2U);
  EXPECT_EQ(rows->unreadable(), 2U);
}

TEST(Ledger, OfAFullDiskSaysSo) {
  auto ledger = Ledger::open("/dev/full");
  ASSERT_FALSE(ledger.has_value() && ledger->append(sample(1)).has_value());
}

}  // namespace
}  // namespace rave::experiment
