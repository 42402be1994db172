// SPDX-License-Identifier: Apache-2.0
// A record is run again; whatever is not as it was recorded is found and named.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include "process.hpp"
#include "rave/run_testing/recorded_run.hpp"

namespace rave::cli_test {
namespace {

class Verify : public testing::Test {
 protected:
  void SetUp() override {
    record_ = folder_.path() / "run" / "run.mcap";
    const Ended ended = run_rave({"run", "played.yaml", "--duration", "2", "--output",
                                  folder_.path() / "run", "--no-picture", "--quiet"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    changed_ = folder_.path() / "changed.mcap";
  }
  /// Changes the given bit of the message of that step and topic, from the end of the message.
  Changes flipped(const std::string& topic, int step, std::size_t from_end) {
    Changes changes;
    changes.message = [=, seen = 0](const std::string& name,
                                    std::vector<std::byte>& bytes) mutable {
      if (name != topic || seen++ != step) return;
      bytes[bytes.size() - from_end] ^= std::byte{1};
    };
    return changes;
  }
  Ended verify_changed(const Changes& changes) {
    copy_record(record_, changed_, changes);
    return run_rave({"verify", changed_});
  }

  TemporaryFolder folder_;
  std::filesystem::path record_;
  std::filesystem::path changed_;
};

TEST_F(Verify, TheSameRunIsTheSame) {
  const Ended ended = run_rave({"verify", folder_.path() / "run"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("equal: 200 steps, "), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("run hash " + hash_of(record_)), std::string::npos) << ended.out;
  EXPECT_EQ(run_rave({"verify", record_, "--threads", "2", "--quiet"}).exit_code, 0);
}

TEST_F(Verify, ACopyWithoutChangesIsTheSame) { EXPECT_EQ(verify_changed({}).exit_code, 0); }

TEST_F(Verify, OneBitOfAReadingIsFound) {
  // The last bytes of the records of a step are those of bert's odometry.
  const Ended ended = verify_changed(flipped(record::topic::kPercepts, 123, 8));
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("first in step 123 (1.230 s): robot bert, sensor odometry"),
            std::string::npos)
      << ended.err;
}

TEST_F(Verify, OneBitOfAPoseIsFound) {
  // Behind the array of poses: a reserved word and the count of true poses, anna's true pose.
  const Ended ended = verify_changed(flipped(record::topic::kPoses, 77, 8));
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("first in step 77 (0.770 s): robot anna, pose"), std::string::npos)
      << ended.err;
}

TEST_F(Verify, OneBitOfACommandIsFound) {
  const Ended command = verify_changed(flipped(record::topic::kCommands, 0, 20));
  EXPECT_EQ(command.exit_code, 1);
  EXPECT_NE(command.err.find("step 0 (0.000 s): robot bert, command to controller 0"),
            std::string::npos)
      << command.err;
  const Ended actuator = verify_changed(flipped(record::topic::kActuators, 0, 20));
  EXPECT_EQ(actuator.exit_code, 1);
  EXPECT_NE(actuator.err.find("step 0 (0.000 s): robot bert, command to actuator 0"),
            std::string::npos)
      << actuator.err;
}

TEST_F(Verify, ARunThatGoesAnotherWayIsFoundWhereItBegins) {
  Changes changes;
  changes.attachment = [](const std::string&, std::string text) {
    const std::size_t at = text.find("\nseed: 1");
    EXPECT_NE(at, std::string::npos);
    return text.replace(at, 8, "\nseed: 2");
  };
  const Ended ended = verify_changed(changes);
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  // The first thing that depends on chance: noise of the first odometry that has moved, or wander's
  // first choice. Either way long before the end.
  const std::size_t at = ended.err.find("first in step ");
  ASSERT_NE(at, std::string::npos) << ended.err;
  EXPECT_LT(std::stoi(ended.err.substr(at + 14)), 50) << ended.err;
  EXPECT_NE(ended.err.find("robot "), std::string::npos) << ended.err;
}

TEST_F(Verify, OnlyTheHashDiffers) {
  Changes changes;
  changes.message = [](const std::string& topic, std::vector<std::byte>& bytes) {
    if (topic == record::topic::kEnd) bytes.back() ^= std::byte{1};
  };
  const Ended ended = verify_changed(changes);
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_NE(ended.err.find("all streams of the recording are equal"), std::string::npos)
      << ended.err;
}

TEST_F(Verify, InputFilesThatAreMissingOrDifferAreNamed) {
  const std::filesystem::path input = folder_.path() / "hall.pgm";
  Changes changes;
  changes.metadata = [&](const std::string& name, record::StringMap& entries) {
    if (name == "rave.run") entries["note"] = "copied";
  };
  // A run with an input: robots of the first run, played.
  const std::string played = folder_.path() / "played";
  ASSERT_EQ(run_rave({"play", record_, "--output", played, "--no-picture", "--quiet"}).exit_code,
            0);
  EXPECT_EQ(run_rave({"verify", played}).exit_code, 0);
  // As an earlier version left it: without the content of its inputs.
  const std::filesystem::path old = folder_.path() / "old.mcap";
  Changes without;
  without.drops_attachment = [](const std::string& name) { return name.starts_with("inputs/"); };
  copy_record(std::filesystem::path(played) / "run.mcap", old, without);

  // Another file in its place, of the same readings: named, and the run is still the same.
  copy_record(record_, changed_, changes);
  std::filesystem::copy_file(changed_, record_, std::filesystem::copy_options::overwrite_existing);
  const Ended other = run_rave({"verify", old});
  EXPECT_EQ(other.exit_code, 0) << other.err;
  EXPECT_NE(
      other.err.find("the input file `" + record_.string() + "` has changed since the recording"),
      std::string::npos)
      << other.err;
  const Ended own = run_rave({"verify", played});
  EXPECT_EQ(own.exit_code, 0) << own.err;
  EXPECT_NE(own.err.find("`" + record_.string() +
                         "` has changed since the recording; the one in the recording is used"),
            std::string::npos)
      << own.err;

  std::filesystem::remove(record_);
  EXPECT_EQ(run_rave({"verify", played}).exit_code, 0) << "its own copy is enough";
  const Ended missing = run_rave({"verify", old});
  EXPECT_EQ(missing.exit_code, 2);
  EXPECT_NE(missing.err.find("missing: cannot open `" + record_.string() + "`"), std::string::npos)
      << missing.err;
}

/// What is not there cannot differ, so that alone is a difference.
TEST_F(Verify, ReadingsThatAreMissingAreFound) {
  Changes changes;
  changes.drops = [](const std::string& topic, std::uint64_t time_ns) {
    return topic == record::topic::kPercepts && time_ns >= 1'500'000'000;
  };
  const Ended ended = verify_changed(changes);
  EXPECT_EQ(ended.exit_code, 1) << ended.out;
  EXPECT_NE(ended.err.find("first in step 150 (1.500 s)"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("recorded: nothing; now: "), std::string::npos) << ended.err;
}

TEST_F(Verify, ARecordWithoutItsSecondHalfIsFound) {
  Changes changes;
  changes.drops = [](const std::string& topic, std::uint64_t time_ns) {
    return topic != record::topic::kEnd && time_ns >= 1'000'000'000;
  };
  const Ended ended = verify_changed(changes);
  EXPECT_EQ(ended.exit_code, 1) << ended.out;
  EXPECT_NE(ended.err.find("the recorded messages end here"), std::string::npos) << ended.err;
}

TEST_F(Verify, ARecordWithoutAnythingToCompareIsRefused) {
  Changes changes;
  changes.drops = [](const std::string& topic, std::uint64_t) {
    return topic != record::topic::kRun && topic != record::topic::kConsole;
  };
  const Ended ended = verify_changed(changes);
  EXPECT_NE(ended.exit_code, 0) << ended.out;
  EXPECT_NE(ended.err.find("it contains nothing to compare"), std::string::npos) << ended.err;
}

TEST_F(Verify, AnotherVersionIsNamed) {
  Changes changes;
  changes.message = [](const std::string& topic, std::vector<std::byte>& bytes) {
    if (topic != record::topic::kRun) return;
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::size_t at = text.find("program wander");
    ASSERT_NE(at, std::string_view::npos);
    const std::size_t version = text.find("1.0", at);
    ASSERT_NE(version, std::string_view::npos);
    bytes[version] = std::byte{'7'};
  };
  const Ended ended = verify_changed(changes);
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.err.find("program wander was version 7.0 in the recording and is 1.0 here"),
            std::string::npos)
      << ended.err;
}

TEST_F(Verify, ARecordThatBrokeOffIsComparedAsFarAsItGoes) {
  Changes small;
  small.chunk_bytes = 20'000;
  copy_record(record_, changed_, small);
  const std::string whole = content_of(changed_);
  std::ofstream(changed_, std::ios::binary) << whole.substr(0, whole.size() * 3 / 4);
  const Ended ended = run_rave({"verify", changed_});
  EXPECT_EQ(ended.exit_code, 1) << ended.out;
  EXPECT_EQ(ended.out.find("equal:"), std::string::npos) << ended.out;
  const std::size_t at = ended.err.find("incomplete: ");
  ASSERT_NE(at, std::string::npos) << ended.err;
  const int steps = std::stoi(ended.err.substr(at + std::string_view("incomplete: ").size()));
  EXPECT_GT(steps, 50);
  EXPECT_LT(steps, 200);
  EXPECT_NE(ended.err.find(fmt::format(" compared and equal, to {:.3f} s: the recording breaks off "
                                       "there",
                                       steps * 0.01)),
            std::string::npos)
      << ended.err;
}

/// As a tool that filters topics leaves it.
TEST_F(Verify, ARecordThatLacksAStreamIsNotWhole) {
  Changes changes;
  changes.drops_channel = [](const std::string& topic) { return topic == record::topic::kEvents; };
  const Ended ended = verify_changed(changes);
  EXPECT_EQ(ended.exit_code, 1) << ended.out;
  EXPECT_NE(ended.err.find("incomplete: 200 steps, "), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("the recording has no stream `/rave/events`"), std::string::npos)
      << ended.err;
}

/// As a tool leaves it that copies messages only.
TEST_F(Verify, ARecordWithoutItsAttachmentsIsNamedByEachCommand) {
  Changes changes;
  changes.drops_attachment = [](const std::string&) { return true; };
  copy_record(record_, changed_, changes);
  const std::string said = "`" + changed_.string() +
                           "` has no scenario: its attachment `scenario.yaml` is missing or "
                           "damaged";
  for (const char* const command : {"verify", "play", "gui"}) {
    std::vector<std::string> words = {command, changed_};
    if (std::string_view(command) == "gui") words.emplace_back("--no-open");
    const Ended ended = run_rave(words);
    EXPECT_EQ(ended.exit_code, 2) << command;
    EXPECT_NE(ended.err.find(said), std::string::npos) << command << ": " << ended.err;
  }
  const Ended info = run_rave({"info", changed_});
  EXPECT_EQ(info.exit_code, 1) << info.out;
  EXPECT_NE(info.out.find("lost: its scenario"), std::string::npos) << info.out;
  EXPECT_EQ(info.out.find("complete"), std::string::npos) << info.out;
}

TEST_F(Verify, ADamagedRecordIsRefusedAndTheDamageIsNamed) {
  const Ended good = run_rave({"info", record_, "--check", "--json"});
  EXPECT_EQ(good.exit_code, 0) << good.out;
  EXPECT_NE(good.out.find("\"whole\": true"), std::string::npos) << good.out;
  // The chunk in the middle has neither the beginning nor the end of the run.
  Changes small;
  small.chunk_bytes = 20'000;
  copy_record(record_, changed_, small);
  std::string bytes = content_of(changed_);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  std::ofstream(changed_, std::ios::binary) << bytes;

  const Ended quick = run_rave({"info", changed_});
  EXPECT_EQ(quick.exit_code, 0) << quick.err;
  EXPECT_EQ(quick.out.find("checksums are correct"), std::string::npos) << quick.out;
  EXPECT_NE(quick.out.find("--check verifies the checksums"), std::string::npos) << quick.out;
  const Ended quick_json = run_rave({"info", changed_, "--json"});
  EXPECT_NE(quick_json.out.find("\"whole\": null"), std::string::npos) << quick_json.out;

  const Ended checked = run_rave({"info", changed_, "--check"});
  EXPECT_EQ(checked.exit_code, 1) << checked.out;
  EXPECT_NE(checked.out.find("damaged: `" + changed_.string() + "`: the chunk at offset "),
            std::string::npos)
      << checked.out;
  const Ended verified = run_rave({"verify", changed_});
  EXPECT_EQ(verified.exit_code, 2) << verified.out;
  EXPECT_NE(verified.err.find("the recording is damaged, so nothing is compared: `"),
            std::string::npos)
      << verified.err;
}

TEST(VerifyLive, CannotBe) {
  const TemporaryFolder folder;
  const std::string scenario = folder.path() / "live.yaml";
  std::ofstream(scenario) << "name: live\nduration_s: 0.3\nmax_missed_pct: 100\n"
                             "robots:\n  - {name: it, file: "
                          << RAVE_SOURCE_DIR
                          << "/robots/recorded-create.yaml, variables: {clock: live}}\n";
  const std::string run = folder.path() / "run";
  ASSERT_EQ(run_rave({"run", scenario, "--output", run, "--no-picture"}).exit_code, 0);
  const Ended ended = run_rave({"verify", run});
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_NE(ended.err.find("cannot be verified: `mocap` of robot `it` uses the driver "
                           "`utias_mocap`, which follows the wall clock"),
            std::string::npos)
      << ended.err;
}

}  // namespace
}  // namespace rave::cli_test
