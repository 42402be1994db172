// SPDX-License-Identifier: Apache-2.0
// Short texts, rates, what a process costs, and which run a word stands for.
#include <gtest/gtest.h>
#include <unistd.h>

#include "process_usage.hpp"
#include "rave/base/text_width.hpp"
#include "rave/watch/observer.hpp"
#include "rave/watch/run_model.hpp"
#include "short_text.hpp"

namespace rave::watch {
namespace {

constexpr std::int64_t kOneSecond = 1'000'000'000;

TEST(ShortText, TimesInTheUnitThatFits) {
  EXPECT_EQ(time_text(0.00031), "310 us");
  EXPECT_EQ(time_text(0.0042), "4.2 ms");
  EXPECT_EQ(time_text(0.045), "45 ms");
  EXPECT_EQ(time_text(1.31), "1.3 s");
  EXPECT_EQ(time_text(215), "215 s");
  EXPECT_EQ(time_text(0), "0 us");
  EXPECT_EQ(time_text(-1.5), "-1.5 s");
  EXPECT_EQ(offset_text(0.0012, 0.00008), "+1.20±0.08 ms");
  EXPECT_EQ(offset_text(-0.00001, 0.00012), "-10.00±120.00 us");
}

TEST(ShortText, NumbersWithThreeDigits) {
  EXPECT_EQ(number_text(0.5), "0.50");
  EXPECT_EQ(number_text(9.996), "10.0");
  EXPECT_EQ(number_text(49.84), "49.8");
  EXPECT_EQ(number_text(4890.4), "4890");
}

TEST(ShortText, NoNameMovesTheCursorOrIsTooWide) {
  EXPECT_EQ(fitted("a\x1b[2Jb\n", 10), "a[2Jb");
  EXPECT_EQ(fitted("a\xc2\x9b"
                   "2Jb",
                   10),
            "a2Jb");
  EXPECT_EQ(fitted("Roboter-Größe", 13), "Roboter-Größe");
  EXPECT_EQ(fitted("Größe", 4), "Grö…");
  EXPECT_EQ(fitted("abc", 0), "");
  EXPECT_EQ(columns_of("Größe"), 5U);
}

TEST(Rate, CountsPerSecondAndFallsInSilence) {
  Rate rate;
  EXPECT_FALSE(rate.at(0));
  rate.add(0, 0);
  EXPECT_FALSE(rate.at(kOneSecond));
  rate.add(kOneSecond, 50);
  rate.add(2 * kOneSecond, 100);
  EXPECT_DOUBLE_EQ(*rate.at(2 * kOneSecond), 50);
  EXPECT_DOUBLE_EQ(*rate.at(3 * kOneSecond), 50) << "the next one may be on its way";
  EXPECT_DOUBLE_EQ(*rate.at(12 * kOneSecond), 10);
}

TEST(Rate, KeepsFewReadingsHoweverManyCome) {
  Rate rate;
  for (int i = 0; i <= 60'000; ++i) rate.add(i * (kOneSecond / 5000), i);
  EXPECT_NEAR(*rate.at(12 * kOneSecond), 5000, 1);
  EXPECT_LE(rate.kept(), 55U);
  // What stops is seen as soon as before.
  EXPECT_LT(*rate.at(17 * kOneSecond), 2600);
}

TEST(Rate, ForgetsWhatIsLongAgoAndBeginsAnew) {
  Rate rate;
  for (int i = 0; i <= 20; ++i) rate.add(i * kOneSecond, i < 10 ? 0 : 100.0 * (i - 10));
  EXPECT_DOUBLE_EQ(*rate.at(20 * kOneSecond), 100);
  rate.add(21 * kOneSecond, 5);
  EXPECT_FALSE(rate.at(21 * kOneSecond)) << "another start of the same process";
}

TEST(Usage, ReadsWhatTheKernelSays) {
  const auto usage =
      parse_usage("4711 (a) b (c) S 1 4711 4711 0 -1 4194560 100 0 0 0 150 50 0 0 20 0 4 0 1 2 3",
                  "1000 250 9", 100, 4096);
  ASSERT_TRUE(usage);
  EXPECT_DOUBLE_EQ(usage->cpu_s, 2);
  EXPECT_DOUBLE_EQ(usage->memory_mb, 1.024);
  EXPECT_FALSE(parse_usage("4711 name S 1", "1 2", 100, 4096));
  EXPECT_FALSE(parse_usage("1 (a) S 1 2", "1 2", 100, 4096));
  EXPECT_FALSE(parse_usage("", "", 100, 4096));
  EXPECT_GT(usage_of(static_cast<std::uint32_t>(::getpid()))->memory_mb, 1);
}

std::string reason(const std::vector<FoundRun>& found, std::string_view word) {
  const auto chosen = choose_run(found, word);
  return chosen ? chosen->text().substr(0, 4) : chosen.error().message;
}

TEST(ChooseRun, ByNameNumberOrAlone) {
  FoundRun one;
  one.run = bus::run_of_name("morning");
  one.processes = {"environment manager", "left"};
  FoundRun other;
  other.run.bytes.fill(0xab);
  other.processes = {"right"};
  EXPECT_EQ(reason({}, ""), "no run of several processes is in progress");
  EXPECT_EQ(reason({other}, ""), "abab");
  EXPECT_EQ(reason({one, other}, "abab"), "abab");
  EXPECT_EQ(reason({one, other}, "morning"), one.run.text().substr(0, 4));
  EXPECT_EQ(reason({one, other}, ""),
            "2 runs are in progress; name one: " + one.run.text().substr(0, 8) +
                " (of environment manager and left); abababab (of right)");
  EXPECT_EQ(reason({other}, "evening"),
            "there is no run `evening`; runs in progress: abababab (of right)");
  EXPECT_EQ(reason({other}, "aba").substr(0, 22), "there is no run `aba`;") << "too few digits";
  EXPECT_TRUE(is_named(one.run, "morning"));
  EXPECT_TRUE(is_named(other.run, other.run.text()));
  EXPECT_FALSE(is_named(other.run, "abababab")) << "there may be another one that begins so";
}

}  // namespace
}  // namespace rave::watch
