// SPDX-License-Identifier: Apache-2.0
// How long a command takes from the actuator driver to the bytes at the robot's end of the line,
// and a frame from the robot to the reading at the host. Prints one JSON object.
// usage: bench_create_line [COMMANDS]
#include <algorithm>
#include <fstream>
#include <map>
#include <random>
#include <sstream>

#include "../tests/integration/create_bench.hpp"

namespace rave::oi {
namespace {

using Clock = std::chrono::steady_clock;

nlohmann::json spread(std::vector<double> times_ms) {
  if (times_ms.empty()) return nullptr;
  std::sort(times_ms.begin(), times_ms.end());
  const auto at = [&](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  return {{"count", times_ms.size()},
          {"median_ms", at(0.5)},
          {"p99_ms", at(0.99)},
          {"largest_ms", times_ms.back()}};
}

std::int64_t monotonic_ns(Clock::time_point t) { return t.time_since_epoch().count(); }

/// Wheel speeds that tell which command it was.
std::pair<int, int> code_of(int i) { return {100 + i % 300, 100 + i / 300 % 300}; }

Command command_of(int i) {
  const auto [left, right] = code_of(i);
  return velocity_command((left + right) * 0.5e-3, (right - left) * 1e-3 / 0.235);
}

/// When each pair of wheel speeds came first, and when frames left, as the peer wrote it down.
struct Heard {
  std::map<std::pair<int, int>, std::int64_t> drives_ns;
  std::vector<std::int64_t> frames_ns;
};

Heard heard(const std::string& log) {
  Heard all;
  std::ifstream file(log);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    std::int64_t at_ns = 0;
    std::int64_t lived_ns = 0;
    std::pair<int, int> speeds;
    words >> kind >> at_ns >> lived_ns >> speeds.first >> speeds.second;
    if (kind == "drive") all.drives_ns.try_emplace(speeds, at_ns);
    if (kind == "frame") all.frames_ns.push_back(at_ns);
  }
  return all;
}

int count = 2000;

TEST(LineBench, Times) {
  CreateBench bench;
  ASSERT_NO_FATAL_FAILURE(bench.start());
  std::vector<std::int64_t> given_ns;
  std::mt19937 random(1);
  for (int i = 0; i < count; ++i) {
    // At any phase of the stream and of the refresh.
    std::this_thread::sleep_for(std::chrono::microseconds(4000 + random() % 8000));
    given_ns.push_back(monotonic_ns(Clock::now()));
    ASSERT_EQ(bench.drive.write(command_of(i)), "");
  }
  bench.await_state([](const nlohmann::json& s) { return s["deaf"] == 0; });
  const Heard all = heard(bench.log_path());
  std::vector<double> commands_ms;
  for (int i = 0; i < count; ++i) {
    const auto found = all.drives_ns.find(code_of(i));
    if (found == all.drives_ns.end()) continue;
    commands_ms.push_back(
        static_cast<double>(found->second - given_ns[static_cast<std::size_t>(i)]) * 1e-6);
  }
  std::vector<double> frames_ms;
  for (const auto& sample : bench.poses->samples()) {
    // The last frame that left before the reading was there.
    const auto next = std::find_if(
        all.frames_ns.begin(), all.frames_ns.end(),
        [&](std::int64_t at_ns) { return bench.poses->clock().at_ns(at_ns) > sample.published; });
    if (next == all.frames_ns.begin()) continue;
    frames_ms.push_back((sample.published - bench.poses->clock().at_ns(*(next - 1))).seconds() *
                        1e3);
  }
  const nlohmann::json result{{"commands_given", count},
                              {"command_to_line", spread(std::move(commands_ms))},
                              {"frame_to_reading", spread(std::move(frames_ms))}};
  std::printf("%s\n", result.dump(2).c_str());
}

}  // namespace
}  // namespace rave::oi

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  // The object is all that is to be read.
  auto& listeners = ::testing::UnitTest::GetInstance()->listeners();
  delete listeners.Release(listeners.default_result_printer());
  if (argc > 1) rave::oi::count = std::max(1, std::atoi(argv[1]));
  return RUN_ALL_TESTS();
}
