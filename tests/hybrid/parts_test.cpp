// SPDX-License-Identifier: Apache-2.0
// The record has both parts and the result of every reading; the program has one reading.
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "hybrid_fixture.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/record_summary.hpp"
#include "rave/record/run_messages.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/robot/percepts.hpp"

namespace rave::tests {
namespace {

class Parts : public HybridTest {
 protected:
  std::string text() {
    const std::string eye =
        "{name: eye, driver: hybrid_ranges, mount: {z_m: 0.1}, noise: {length_quantum_m: 0.25}, "
        "latency_s: 0.03, real: {driver: still_ranges, params: {rays: 21, fov_deg: 60, period_s: "
        "0.03}, noise: {length_sigma_m: 0.05}}, virtual: {driver: virtual_laser, params: {rays: "
        "21, "
        "fov_deg: 60}, noise: {length_sigma_m: 0.01}}}";
    return scenario(robot(eye, "turn_radps: 0.4",
                          ", program: {driver: notebook, params: {file: " + note() + "}}"),
                    box_at(1.2));
  }
  [[nodiscard]] std::string note() const { return (folder_ / "note").string(); }
};

bool same(const SampleHeader& header, const void* records, const record::Percept& percept) {
  return percept.header.stamp_ns == header.stamp_ns && percept.header.count == header.count &&
         percept.header.sequence == header.sequence &&
         percept.records.size() == header.count * sizeof(float) &&
         std::memcmp(percept.records.data(), records, percept.records.size()) == 0;
}

TEST_F(Parts, ComeBackBitForBit) {
  const auto outcome = run(text());
  ASSERT_TRUE(outcome) << outcome.error().text();

  // The same run once more, compared with what the first one wrote.
  auto reader = record::McapReader::open(folder_ / "run/run.mcap");
  ASSERT_TRUE(reader) << reader.error().text();
  auto cursor = reader->messages({{reader->channel(record::topic::kPercepts)->id}});
  const auto engine = engine_of(text());
  std::array<int, 3> found{};
  for (auto message = cursor.next(); message && *message; message = cursor.next()) {
    const auto step = record::decode_percepts((*message)->bytes);
    ASSERT_TRUE(step) << step.error().text();
    while (engine->steps_done() <= step->step) steps(*engine, 1);
    for (const record::Percept& percept : step->items) {
      if (percept.sensor != DeviceId(1)) {
        EXPECT_EQ(percept.part, record::PerceptPart::kResult);
        continue;
      }
      ++found.at(static_cast<std::size_t>(percept.part));
      const sim::SensorParts parts = engine->sensor_parts(RobotId(0), 1);
      const sim::SensorSample result = engine->sensor(RobotId(0), 1);
      switch (percept.part) {
        case record::PerceptPart::kReal:
          EXPECT_TRUE(same(*parts.real, parts.real_records, percept));
          break;
        case record::PerceptPart::kVirtual:
          EXPECT_TRUE(same(*parts.imagined, parts.imagined_records, percept));
          break;
        case record::PerceptPart::kResult:
          EXPECT_TRUE(same(*result.header, result.records, percept));
          break;
      }
    }
  }
  EXPECT_EQ(found[1], 34);  // every 30 ms of the second
  EXPECT_EQ(found[2], 34);
  EXPECT_EQ(found[0], 33);  // the last is still on its way

  const auto summary = record::describe_record(folder_ / "run/run.mcap");
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->hybrids, (record::StringMap{{"anna/eye",
                                                  "hybrid_ranges of still_ranges (real) and "
                                                  "virtual_laser (virtual)"}}));
}

// What a replay shows as virtual of a real robot must not depend on the name of a driver.
TEST_F(Parts, TheRecordingSaysWhichSensorsOfARealRobotAreVirtual) {
  const auto outcome = run(scenario(robot("{name: eye, driver: virtual_laser}")));
  ASSERT_TRUE(outcome) << outcome.error().text();
  const auto reader = record::McapReader::open(folder_ / "run/run.mcap");
  ASSERT_TRUE(reader) << reader.error().text();
  const auto info = record::read_run_info(*reader);
  ASSERT_TRUE(info) << info.error().text();
  EXPECT_NE(info->robots.at(0).kind, "simulated");
  ASSERT_EQ(info->sensors.size(), 2U);
  EXPECT_FALSE(info->sensors[0].is_virtual) << info->sensors[0].name;
  EXPECT_TRUE(info->sensors[1].is_virtual) << info->sensors[1].name;
}

TEST_F(Parts, AreRecordedOnceWhenAnotherRobotIsHandedOver) {
  const std::string wheels =
      "{body: {shapes: [{disc_radius_m: 0.15, z_m: [0, 0.2]}]}, actuators: [{name: wheels, driver: "
      "differential_drive}], controllers: [{name: drive, driver: velocity, actuator: wheels}]}";
  const auto outcome =
      run(text() + "  - {name: bert, pose: {x_m: 9, y_m: 9}, robot: " + wheels +
          ", twin_robot: " + wheels + "}\nchanges: [{at_s: 0.52, robot: bert, hand_over: twin}]\n");
  ASSERT_TRUE(outcome) << outcome.error().text();
  std::ifstream log(folder_ / "run/events.log");
  const std::string events{std::istreambuf_iterator<char>(log), {}};
  EXPECT_NE(events.find("handed over"), std::string::npos) << events;
  auto reader = record::McapReader::open(folder_ / "run/run.mcap");
  ASSERT_TRUE(reader) << reader.error().text();
  auto cursor = reader->messages({{reader->channel(record::topic::kPercepts)->id}});
  std::array<std::uint32_t, 3> last{};
  int parts = 0;
  for (auto message = cursor.next(); message && *message; message = cursor.next()) {
    const auto step = record::decode_percepts((*message)->bytes);
    ASSERT_TRUE(step) << step.error().text();
    for (const record::Percept& percept : step->items) {
      if (percept.part == record::PerceptPart::kResult) continue;
      std::uint32_t& before = last.at(static_cast<std::size_t>(percept.part));
      EXPECT_GT(percept.header.sequence, before) << "in step " << step->step;
      before = percept.header.sequence;
      ++parts;
    }
  }
  EXPECT_EQ(parts, 2 * 34);
}

TEST_F(Parts, TheProgramGetsOneReadingWithoutATraceOfIt) {
  const auto engine = engine_of(text());
  ASSERT_TRUE(engine);
  steps(*engine, 90);
  const SensorInfo& info = *engine->sensor(RobotId(0), 1).info;
  EXPECT_STREQ(info.name, "eye");
  EXPECT_EQ(info.kind, ReadingKind::kRanges);
  EXPECT_EQ(info.capacity, 21U);
  EXPECT_EQ(info.range_max_m, 6);  // of the real half
  // A program sees a SensorInfo, a SampleHeader and records. Of a plain virtual laser with the same
  // place and rays it sees the same kinds of things: nothing is left to tell them apart by.
  static_assert(sizeof(SensorView) == 2 * sizeof(void*));
  static_assert(sizeof(SampleHeader) == 24);
  std::ifstream file(note());
  std::uint64_t lines = 0;
  std::uint64_t last = 0;
  for (std::string line; std::getline(file, line) && !file.eof(); ++lines) {
    std::istringstream words(line);
    std::uint64_t wall = 0;
    std::int64_t stamp = 0;
    std::uint64_t sequence = 0;
    words >> wall >> stamp >> sequence;
    EXPECT_EQ(sequence, last + 1);  // each of them once
    last = sequence;
  }
  EXPECT_GT(lines, 20U);
}

TEST_F(Parts, TheHashDoesNotDependOnThreads) {
  std::vector<std::uint64_t> hashes;
  for (const char* threads : {"1", "2", "3"}) {
    const auto engine = engine_of("threads: " + std::string(threads) + "\n" + text());
    ASSERT_TRUE(engine);
    steps(*engine, 100);
    hashes.push_back(engine->hash().value());
  }
  EXPECT_EQ(hashes[1], hashes[0]);
  EXPECT_EQ(hashes[2], hashes[0]);
}

}  // namespace
}  // namespace rave::tests
