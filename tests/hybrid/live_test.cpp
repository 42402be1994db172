// SPDX-License-Identifier: Apache-2.0
// From the serial line to the program: a laser that speaks SCIP in a process of its own, fused with
// a virtual box while the run goes by the wall clock.
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "hybrid_fixture.hpp"
#include "rave/live_testing/peer_process.hpp"
#include "rave/record/mcap_reader.hpp"
#include "rave/record/run_messages.hpp"

namespace rave::tests {
namespace {

struct Line {
  std::int64_t wall_ns = 0;  ///< CLOCK_MONOTONIC: when it was measured, or got by the program.
  std::vector<float> ranges_m;
};

/// What the peer measured, as a right driver understands it.
std::vector<Line> read_peer(const std::filesystem::path& path) {
  std::vector<Line> lines;
  std::ifstream file(path);
  for (std::string text; std::getline(file, text) && !file.eof();) {
    std::istringstream words(text);
    Line line;
    std::string number;
    std::string timer;
    std::string fault;
    words >> number >> line.wall_ns >> timer >> fault;
    for (int mm = 0; words >> mm;) {
      line.ranges_m.push_back(mm < 20 || mm > 5600 ? kNoReturn : static_cast<float>(mm) * 1e-3F);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// When the program got each reading, by its number.
std::map<std::uint32_t, std::int64_t> read_notebook(const std::filesystem::path& path) {
  std::map<std::uint32_t, std::int64_t> got;
  std::ifstream file(path);
  for (std::string text; std::getline(file, text) && !file.eof();) {
    std::istringstream words(text);
    std::int64_t wall_ns = 0;
    std::int64_t stamp_ns = 0;
    std::uint32_t sequence = 0;
    words >> wall_ns >> stamp_ns >> sequence;
    got[sequence] = wall_ns;
  }
  return got;
}

using Scan = std::vector<float>;
struct Recorded {
  Scan part[3];  ///< By record::PerceptPart.
};

std::map<std::uint32_t, Recorded> read_record(const std::filesystem::path& path) {
  std::map<std::uint32_t, Recorded> found;
  auto reader = record::McapReader::open(path);
  EXPECT_TRUE(reader);
  if (!reader) return found;
  auto cursor = reader->messages({{reader->channel(record::topic::kPercepts)->id}});
  for (auto message = cursor.next(); message && *message; message = cursor.next()) {
    const auto step = record::decode_percepts((*message)->bytes);
    EXPECT_TRUE(step);
    for (const record::Percept& percept : step->items) {
      if (percept.sensor != DeviceId(1)) continue;
      Scan scan(percept.header.count);
      std::memcpy(scan.data(), percept.records.data(), percept.records.size());
      found[percept.header.sequence].part[static_cast<std::size_t>(percept.part)] = scan;
    }
  }
  return found;
}

nlohmann::json statistics(std::vector<double> times_ms) {
  std::sort(times_ms.begin(), times_ms.end());
  const auto at = [&](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  return {{"count", times_ms.size()},
          {"median_ms", at(0.5)},
          {"p99_ms", at(0.99)},
          {"max_ms", times_ms.back()},
          {"limit_p99_ms", 5.0}};
}

/// Seconds that the run lasts and step: longer and finer for a measurement (see README).
std::string setting(const char* name, const char* usual) {
  const char* const given = std::getenv(name);
  return given != nullptr ? given : usual;
}

TEST_F(HybridTest, AScanFromTheSerialLineReachesTheProgramWithTheVirtualBoxInIt) {
  const std::string link = (folder_ / "laser").string();
  testing::PeerProcess peer("peer_scip", {"--rpm", "2400", "--link", link, "--log",
                                          (folder_ / "log").string(), "--pose", "2,1.5,0"});
  const std::string eye =
      "{name: eye, driver: hybrid_ranges, mount: {z_m: 0.1}, real: {driver: scip_laser, params: "
      "{device: " +
      link +
      "}}, virtual: {driver: virtual_laser, params: {rays_of_real_half: true, "
      "range_max_m: 5.6}}}";
  const std::string note = (folder_ / "note").string();
  std::string text = scenario(
      robot(eye, "x_m: 2, y_m: 1.5", ", program: {driver: notebook, params: {file: " + note + "}}"),
      "obstacles: [{name: box, box_m: [0.2, 0.2], x_m: 2.6, y_m: 1.5, z_m: [0, 1]}]\n", "",
      setting("RAVE_HYBRID_STEP_S", "0.002"));
  const auto duration = text.find("duration_s: 1\n");
  text.replace(duration, 13, "duration_s: " + setting("RAVE_HYBRID_DURATION_S", "2"));
  const auto outcome = run(text);
  ASSERT_TRUE(outcome) << outcome.error().text();
  EXPECT_TRUE(outcome->hash.empty());  // a live run

  const std::vector<Line> peer_scans = read_peer(folder_ / "log");
  const auto got = read_notebook(note);
  const auto recorded = read_record(folder_ / "run/run.mcap");
  ASSERT_GT(recorded.size(), 10U);
  std::vector<double> times_ms;
  std::size_t next = 0;
  std::size_t with_box = 0;
  for (const auto& [sequence, reading] : recorded) {
    const Scan& real = reading.part[1];
    const Scan& imagined = reading.part[2];
    ASSERT_EQ(real.size(), imagined.size());
    ASSERT_EQ(real.size(), reading.part[0].size());
    for (std::size_t i = 0; i < real.size(); ++i) {
      ASSERT_EQ(reading.part[0][i], std::min(real[i], imagined[i])) << sequence << " " << i;
    }
    // The front of the box is half a metre ahead.
    const float nearest = *std::min_element(imagined.begin(), imagined.end());
    EXPECT_FLOAT_EQ(nearest, 0.5F);
    with_box += reading.part[0] != real ? 1U : 0U;
    while (next < peer_scans.size() && peer_scans[next].ranges_m != real) ++next;
    ASSERT_LT(next, peer_scans.size()) << "scan " << sequence << " was never measured";
    if (const auto at = got.find(sequence); at != got.end()) {
      times_ms.push_back(static_cast<double>(at->second - peer_scans[next].wall_ns) * 1e-6);
    }
  }
  EXPECT_EQ(with_box, recorded.size());
  ASSERT_GT(times_ms.size(), 10U);
  // To be read by people; a busy machine must not make a test fail.
  nlohmann::json report = statistics(times_ms);
  report["what"] = "sample at the serial line to fused reading at the program";
  report["step_s"] = std::stod(setting("RAVE_HYBRID_STEP_S", "0.002"));
  std::printf("%s\n", report.dump().c_str());
}

}  // namespace
}  // namespace rave::tests
