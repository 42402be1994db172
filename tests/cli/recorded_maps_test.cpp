// SPDX-License-Identifier: Apache-2.0
// A recording is shown, played and verified with the map that its run had, wherever that is now.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "rave/gui_server/source.hpp"
#include "rave/run_testing/recorded_run.hpp"
#include "shared_world.hpp"

namespace rave::cli_test {
namespace {

namespace fs = std::filesystem;

class RecordedMaps : public SharedWorld {
 protected:
  void SetUp() override {
    // The image is not beside the YAML, as in some folders of maps.
    write("world/lab.yaml",
          "image: ../images/lab.pgm\nresolution: 0.5\norigin: [-1, -1, 0]\nnegate: 0\n"
          "occupied_thresh: 0.65\nfree_thresh: 0.2\n");
    write("images/lab.pgm", "P2\n8 5 255\n" + kRow + kHollow + kHollow + kHollow + kRow);
    write("s.yaml", "name: walled\nduration_s: 1\nworld: world/w.yaml\nrobots:\n" +
                        robot("anna", "{x_m: 0, y_m: 0.2}") +
                        robot("bert", "{x_m: 1.6, y_m: 0.2}"));
    write("world/w.yaml", "maps:\n  - {file: lab.yaml, z_m: [0, 2]}\n");
  }
  static std::string robot(const std::string& name, const std::string& pose) {
    return "  - name: " + name + "\n    pose: " + pose +
           "\n    robot:\n      body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.3]}]}\n"
           "      sensors: [{name: laser, driver: virtual_laser, mount: {z_m: 0.2}, period_s: 0.1, "
           "params: {fov_deg: 360, rays: 36, range_max_m: 5}}]\n"
           "      actuators: [{name: wheels, driver: differential_drive}]\n"
           "      controllers: [{name: drive, driver: velocity, actuator: wheels}]\n"
           "      program: {driver: wander, period_s: 0.1}\n";
  }
  void write(const std::string& name, const std::string& text) {
    const fs::path path = folder_.path() / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
  }
  void run_it(const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {
        "run", folder_.path() / "s.yaml", "--output", run(), "--no-picture", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = run_rave(words);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    // A run of several processes is merged when it is first opened.
    ASSERT_EQ(run_rave({"info", run()}).exit_code, 0);
    shown_ = shown(record());
    ASSERT_NE(shown_.find("polygon"), std::string::npos);
  }
  void edit_map() { write("images/lab.pgm", "P2\n8 5 255\n" + kRow + kRow + kRow + kRow + kRow); }
  void move_map() {
    fs::remove_all(folder_.path() / "world");
    fs::remove_all(folder_.path() / "images");
  }
  /// What a page shows of the world.
  std::string shown(const fs::path& file) {
    const auto source = gui_server::open_recording(file);
    EXPECT_TRUE(source) << source.error().text();
    if (!source) return {};
    notes_ = (*source)->about().notes;
    return (*source)->bodies_json();
  }
  [[nodiscard]] std::string run() const { return folder("run"); }
  [[nodiscard]] fs::path record() const { return fs::path(run()) / "run.mcap"; }

  /// The state of the world outside; the recording has to do without.
  void expect_all_from(const fs::path& file) {
    EXPECT_EQ(shown(file), shown_);
    const Ended verified = run_rave({"verify", file});
    EXPECT_EQ(verified.exit_code, 0) << verified.err;
    EXPECT_NE(verified.out.find("equal: "), std::string::npos) << verified.out;
    said_ = verified.err;
    const std::string again = folder("again");
    fs::remove_all(again);
    const Ended played = run_rave({"play", file, "--output", again, "--no-picture", "--quiet"});
    ASSERT_NE(played.exit_code, 2) << played.err;
    said_ += played.err;
    // What is played has the map of the run as files of its own.
    EXPECT_EQ(shown(fs::path(again) / "run.mcap"), shown_);
    EXPECT_EQ(content_of(fs::path(again) / "played/maps/1/lab.pgm").substr(0, 11), "P2\n8 5 255\n");
  }

  const std::string kRow = "0 0 0 0 0 0 0 0\n";
  const std::string kHollow = "0 255 255 255 255 255 255 0\n";
  std::string shown_;
  std::string said_;
  std::vector<std::string> notes_;
};

TEST_F(RecordedMaps, TheMapOfTheRunIsUsedAndAnEditedOneIsNamed) {
  run_it();
  EXPECT_EQ(notes_, std::vector<std::string>());
  edit_map();
  expect_all_from(record());
  const std::string note =
      "images/lab.pgm` has changed since the recording; the one in the "
      "recording is used";
  EXPECT_NE(said_.find(note), std::string::npos) << said_;
  shown(record());
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find(note), std::string::npos) << notes_[0];
}

TEST_F(RecordedMaps, NothingButTheRecordingIsNeeded) {
  run_it();
  const fs::path alone = folder_.path() / "alone.mcap";
  fs::rename(record(), alone);
  fs::remove_all(run());
  move_map();
  expect_all_from(alone);
  EXPECT_EQ(said_.find("lab."), std::string::npos) << said_;
}

TEST_F(RecordedMaps, TheRecordingOfSeveralProcessesHasThemOnce) {
  std::vector<std::string> words = {"--processes", "2"};
  for (const std::string& word : apart()) words.push_back(word);
  run_it(words);
  move_map();
  const auto reader = record::McapReader::open(record());
  ASSERT_TRUE(reader);
  std::vector<std::string> names;
  for (const auto& attachment : reader->attachments()) {
    names.push_back(attachment.name.substr(attachment.name.rfind('/') + 1));
  }
  std::ranges::sort(names);
  EXPECT_EQ(names, (std::vector<std::string>{"lab.pgm.zst", "lab.yaml.zst", "scenario.yaml"}));
  expect_all_from(record());
}

TEST_F(RecordedMaps, ARecordingWithoutThemIsReadAsBeforeAndSaysWhatChanged) {
  run_it();
  const fs::path old = folder_.path() / "old.mcap";
  Changes changes;
  changes.drops_attachment = [](const std::string& name) { return name.starts_with("inputs/"); };
  copy_record(record(), old, changes);
  expect_all_from(old);
  EXPECT_EQ(said_.find("lab."), std::string::npos) << said_;
  edit_map();
  EXPECT_NE(shown(old), shown_);
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("images/lab.pgm` has changed since the recording, which has no copy"),
            std::string::npos)
      << notes_[0];
  move_map();
  const auto source = gui_server::open_recording(old);
  ASSERT_FALSE(source);
  EXPECT_NE(source.error().text().find("lab.yaml`: No such file"), std::string::npos)
      << source.error().text();
}

/// Its map, and the log that it plays, are those that come with RAVE.
TEST_F(RecordedMaps, AShippedScenarioOnAnotherMachine) {
  for (const char* const part :
       {"scenarios/hybrid-laser", "worlds", "robots", "data/freiburg-079"}) {
    const fs::path to = folder_.path() / part;
    fs::create_directories(to.parent_path());
    fs::copy(fs::path(RAVE_SOURCE_DIR) / part, to, fs::copy_options::recursive);
  }
  const Ended ended = run_rave({"run", folder_.path() / "scenarios/hybrid-laser", "--output", run(),
                                "--duration", "1", "--no-picture", "--quiet"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  shown_ = shown(record());
  fs::remove_all(folder_.path() / "worlds");
  EXPECT_EQ(shown(record()), shown_);
  EXPECT_EQ(run_rave({"verify", run()}).exit_code, 0);
  const fs::path played = folder_.path() / "played";
  EXPECT_EQ(run_rave({"play", run(), "--robot", "walker-1", "--write", played}).exit_code, 0);
  EXPECT_TRUE(fs::exists(played / "maps/1/freiburg-079-map.pgm"));
  fs::remove_all(folder_.path() / "data");
  EXPECT_EQ(shown(record()), shown_);
  const Ended without = run_rave({"verify", run()});
  EXPECT_EQ(without.exit_code, 0) << without.err;
  EXPECT_NE(without.out.find("equal: 100 steps"), std::string::npos) << without.out;
}

TEST_F(RecordedMaps, ADamagedCopyIsNotUsed) {
  run_it();
  const fs::path changed = folder_.path() / "changed.mcap";
  Changes changes;
  changes.attachment = [](const std::string& name, std::string text) {
    if (name.ends_with("lab.pgm.zst")) text.back() = static_cast<char>(text.back() ^ 1);
    return text;
  };
  copy_record(record(), changed, changes);
  EXPECT_EQ(shown(changed), shown_) << "that outside is used";
  ASSERT_EQ(notes_.size(), 1U);
  EXPECT_NE(notes_[0].find("lab.pgm` in the recording "), std::string::npos) << notes_[0];
}

}  // namespace
}  // namespace rave::cli_test
