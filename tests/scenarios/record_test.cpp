// SPDX-License-Identifier: Apache-2.0
// The record of a run holds what the run did, to the bit.
#include <cstring>

#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"
#include "scenario_fixture.hpp"

namespace rave::tests {
namespace {

class Record : public ScenarioTest {
 protected:
  /// Messages of one topic of the run's record, in order.
  std::vector<std::vector<std::byte>> messages_of(const char* topic) {
    auto reader = record::McapReader::open(folder_ / "run.mcap");
    EXPECT_TRUE(reader) << (reader ? "" : reader.error().text());
    std::vector<std::vector<std::byte>> found;
    if (!reader) return found;
    record::MessageFilter filter;
    for (const auto& channel : reader->channels()) {
      if (channel.topic == topic) filter.channels.push_back(channel.id);
    }
    EXPECT_FALSE(filter.channels.empty()) << topic;
    auto cursor = reader->messages(filter);
    while (true) {
      const auto next = cursor.next();
      EXPECT_TRUE(next) << (next ? "" : next.error().text());
      if (!next || !*next) return found;
      found.emplace_back((*next)->bytes.begin(), (*next)->bytes.end());
    }
  }
};

/// How many sensors have another sample than the last time.
std::size_t count_fresh(const sim::Engine& engine,
                        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t>& seen) {
  std::size_t fresh = 0;
  const sim::EngineSpec& spec = engine.spec();
  for (std::uint32_t r = 0; r < spec.robots.size(); ++r) {
    for (std::uint32_t s = 0; s < spec.types[spec.robots[r].type].sensors.size(); ++s) {
      const std::uint32_t sequence = engine.sensor(RobotId(r), s).header->sequence;
      std::uint32_t& before = seen[{r, s}];
      if (sequence != before) ++fresh;
      before = sequence;
    }
  }
  return fresh;
}

TEST_F(Record, HoldsEveryPerceptAndPoseOfTheRunToTheBit) {
  auto scenario = load("mixed-reality");
  scenario.scenario.duration_s = 3;
  scenario.scenario.picture.reset();
  run(scenario);
  const auto percepts = messages_of(record::topic::kPercepts);
  const auto poses = messages_of(record::topic::kPoses);
  ASSERT_EQ(poses.size(), 300U);

  // The same run once more, compared with what the first one wrote.
  const auto again = make_world(scenario);
  ASSERT_TRUE(again.engine);
  std::size_t compared = 0;
  std::size_t next_percepts = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> seen;
  for (std::uint64_t step = 0; step < 300; ++step) {
    ASSERT_TRUE(again.engine->step());
    const std::size_t fresh = count_fresh(*again.engine, seen);
    const auto recorded_poses = record::decode_poses(poses[step]);
    ASSERT_TRUE(recorded_poses) << recorded_poses.error().text();
    ASSERT_EQ(recorded_poses->step, step);
    for (const record::RobotPose& pose : recorded_poses->items) {
      if (pose.true_pose) {
        EXPECT_EQ(*pose.true_pose, again.engine->snapshot().pose(pose.robot));
      }
    }
    if (fresh == 0) continue;
    ASSERT_LT(next_percepts, percepts.size()) << "readings of step " << step << " are missing";
    const auto recorded = record::decode_percepts(percepts[next_percepts]);
    ASSERT_TRUE(recorded) << recorded.error().text();
    ASSERT_EQ(recorded->step, step);
    ASSERT_EQ(recorded->items.size(), fresh);
    ++next_percepts;
    for (const record::Percept& percept : recorded->items) {
      const auto sample = again.engine->sensor(percept.robot, percept.sensor.value());
      ASSERT_EQ(percept.header.stamp_ns, sample.header->stamp_ns);
      ASSERT_EQ(percept.header.count, sample.header->count);
      ASSERT_EQ(std::memcmp(percept.records.data(), sample.records, percept.records.size()), 0);
      ++compared;
    }
  }
  EXPECT_EQ(next_percepts, percepts.size());
  EXPECT_GT(compared, 1000U);
}

}  // namespace
}  // namespace rave::tests
