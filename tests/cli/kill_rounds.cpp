// SPDX-License-Identifier: Apache-2.0
#include "kill_rounds.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "rave/base/hash.hpp"
#include "rave/record/record_summary.hpp"

namespace rave::cli_test {
namespace {

std::uint64_t test_seed() {
  static const std::uint64_t kSeed = [] {
    const char* const given = std::getenv("RAVE_TEST_SEED");
    return given != nullptr ? std::strtoull(given, nullptr, 10) : std::random_device()();
  }();
  return kSeed;
}

std::uint64_t number_of(std::string_view text) {
  return content_hash(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace

int kill_rounds() {
  const char* const given = std::getenv("RAVE_KILL_ROUNDS");
  const int rounds = given != nullptr ? std::atoi(given) : 5;
  return rounds > 0 ? rounds : 1;
}

RoundChance::RoundChance(std::string_view test, int round)
    : engine_(mix64(test_seed() ^ number_of(test)) + static_cast<std::uint64_t>(round)) {
  std::cout << "RAVE_TEST_SEED=" << test_seed() << " repeats the moments of this round\n";
}

std::vector<std::string> KillRound::of_run(std::vector<std::string> more) const {
  more.insert(more.end(), {"--run", run_.text()});
  return more;
}

void KillRound::kill_process(const std::string& name) {
  signal(name, SIGKILL);
  EXPECT_EQ(end_of(name), -1) << name << " had ended before it was killed\n" << console(name);
}

void KillRound::expect_whole_record(const std::string& name) {
  const Ended info = run_rave({"info", folder(name) + "/run.mcap"});
  EXPECT_EQ(info.exit_code, 0) << name << "\n" << info.out << info.err;
}

void KillRound::expect_readable_record(const std::string& name, double least_s) {
  const std::string file = folder(name) + "/run.mcap";
  // One that was killed before it had anything to record left nothing, or the beginning of a file.
  if (least_s <= 0 && !std::filesystem::exists(file)) return;
  const Ended info = run_rave({"info", file});
  if (least_s <= 0 && info.err.find("there is no complete header") != std::string::npos) return;
  EXPECT_EQ(info.exit_code, 1) << info.err;
  EXPECT_NE(info.out.find("truncated; the part that exists is readable"), std::string::npos)
      << info.out;
  const auto summary = record::describe_record(file);
  ASSERT_TRUE(summary) << summary.error().text();
  EXPECT_GE(summary->end_s, least_s) << info.out;
  // Nothing is broken but its end, which may be a half piece.
  for (const std::string& damage : summary->damages) {
    EXPECT_TRUE(damage.find("without a footer") != std::string::npos ||
                damage.find("from there on are not read") != std::string::npos)
        << damage;
  }
}

}  // namespace rave::cli_test
