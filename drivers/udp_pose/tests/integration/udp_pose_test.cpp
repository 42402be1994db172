// SPDX-License-Identifier: Apache-2.0
// The driver against a process that stands for a motion capture.
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "rave/base_testing/no_threads.hpp"
#include "rave/live_testing/live_driver.hpp"
#include "rave/live_testing/live_sink.hpp"
#include "rave/live_testing/scratch.hpp"
#include "rave/math/scalar.hpp"

namespace rave::udp_pose {
namespace {

using testing::Given;

/// One line of the peer's log.
struct Sent {
  std::int64_t true_ns = 0;  ///< CLOCK_MONOTONIC of the pose.
  std::int64_t leaves_ns = 0;
  double x = 0;
  double y = 0;
  double yaw = 0;
};

class PoseBench {
 public:
  explicit PoseBench(std::vector<std::string> options, Given given = {}) {
    log_ = std::filesystem::temp_directory_path() /
           ("mocap_" + std::to_string(::getpid()) + "_" +
            ::testing::UnitTest::GetInstance()->current_test_info()->name());
    given["body"] = "robot";
    given["port"] = 0.0;
    EXPECT_EQ(driver.configure(given), "");
    EXPECT_EQ(driver.open(sink), "");
    const int port = driver.report()["port"].get<int>();
    options.insert(options.end(), {"--port", std::to_string(port), "--log", log_.string()});
    peer = std::make_unique<testing::PeerProcess>("peer_mocap", options);
  }
  ~PoseBench() {
    driver.close();
    peer.reset();
    std::filesystem::remove(log_);
  }

  /// Every pose that was delivered is one that was sent, in order. The poses as they were sent.
  std::vector<Sent> match() const {
    std::ifstream file(log_);
    std::vector<Sent> all;
    for (std::string line; std::getline(file, line) && !file.eof();) {
      std::istringstream words(line);
      Sent sent;
      std::int64_t number = 0;
      words >> number >> sent.true_ns >> sent.leaves_ns >> sent.x >> sent.y >> sent.yaw;
      all.push_back(sent);
    }
    std::vector<Sent> matched;
    std::size_t i = 0;
    for (const auto& sample : sink.samples()) {
      const PoseReading& pose = sample.records.at(0);
      // The peer writes a yaw of half a turn rounded up, which the driver wraps to the other end.
      while (i < all.size() &&
             (std::abs(all[i].x - pose.x_m) > 2e-9 || std::abs(all[i].y - pose.y_m) > 2e-9 ||
              std::abs(wrap_angle(all[i].yaw - pose.yaw_rad)) > 2e-9)) {
        ++i;
      }
      if (i == all.size()) {
        ADD_FAILURE() << "pose " << matched.size() << " was never sent, or came out of turn";
        return matched;
      }
      matched.push_back(all[i]);
    }
    return matched;
  }

  testing::LiveDriver driver{"udp_pose"};
  testing::LiveSink<PoseReading> sink{ReadingKind::kPose, 1};
  std::unique_ptr<testing::PeerProcess> peer;

 private:
  std::filesystem::path log_;
};

TEST(UdpPose, PosesOfAClockThatIsOffAndDrifts) {
  PoseBench bench(
      {"--clock-start-s", "3", "--drift-ppm", "200", "--delay-s", "0.01", "--noise-m", "0.002"},
      {{"latency_s", 0.01}});
  bench.sink.await_more(200);
  bench.driver.close();
  const auto samples = bench.sink.samples();
  const auto sent = bench.match();
  ASSERT_EQ(sent.size(), samples.size());
  std::vector<double> times_ms;
  double least_s = 1;
  for (std::size_t i = 0; i < sent.size(); ++i) {
    EXPECT_NEAR(samples[i].records[0].variance_xy_m2, 4e-6, 1e-12);
    EXPECT_NEAR(samples[i].records[0].variance_yaw_rad2, 1e-6, 1e-12);
    const double error_s = (samples[i].stamp - bench.sink.clock().at_ns(sent[i].true_ns)).seconds();
    least_s = std::min(least_s, std::abs(error_s));
    times_ms.push_back(
        (samples[i].published - bench.sink.clock().at_ns(sent[i].leaves_ns)).seconds() * 1e3);
  }
  EXPECT_LT(least_s, 0.02) << "stamps are those of the poses, not of their arrival";
  testing::print_times("datagram sent to published", times_ms);
  const auto report = bench.driver.report();
  std::printf("%s\n", report.dump().c_str());
  // The peer's clock showed 3 s when it started, which its first pose tells within its start.
  const double truth_s = static_cast<double>(sent.front().true_ns) * 1e-9 - 3 + 0.01;
  EXPECT_NEAR(report["clock_offset_s"].get<double>(), truth_s, 0.1);
  EXPECT_EQ(report["refused"], 0);
  EXPECT_EQ(bench.sink.queue().complaint(), "");
}

TEST(UdpPose, LossesDuplicatesAndOvertaking) {
  PoseBench bench({"--loss", "0.2", "--twice", "0.2", "--jitter-s", "0.01", "--rate-hz", "200"});
  bench.sink.await_more(200);
  bench.driver.close();
  ASSERT_EQ(bench.match().size(), bench.sink.samples().size());
  const auto report = bench.driver.report();
  std::printf("%s\n", report.dump().c_str());
  EXPECT_GT(report["lost"], 0);
  EXPECT_GT(report["out_of_order"], 0);
  EXPECT_GT(report["duplicates"].get<int>() + report["out_of_order"].get<int>(), 20);
  EXPECT_GT(report["max_delay_s"], 0.0);
  EXPECT_EQ(bench.sink.queue().complaint(), "");
}

TEST(UdpPose, ForeignDatagramsAreCounted) {
  PoseBench bench({});
  bench.sink.await_more(1);
  bench.peer->tell(R"(raw {"body":"robot","t":NaN,"x":0,"y":0,"yaw":0})");
  bench.peer->tell(R"(raw {"body":"cat","t":1,"x":0,"y":0,"yaw":0})");
  bench.sink.await_more(5);
  bench.driver.close();
  EXPECT_EQ(bench.driver.report()["refused"], 1);
  EXPECT_EQ(bench.driver.report()["trouble"], "not JSON");
  EXPECT_EQ(bench.driver.report()["other_bodies"], 1);
  EXPECT_EQ(bench.match().size(), bench.sink.samples().size());
}

TEST(UdpPose, ASecondSenderOfTheBodyDoesNotCountAndIsNamed) {
  PoseBench bench({"--circle", "1,2,0.5,8"});
  bench.sink.await_more(3);
  const int port = bench.driver.report()["port"].get<int>();
  testing::PeerProcess second("peer_mocap",
                              {"--port", std::to_string(port), "--circle", "50,2,0.5,8"});
  const auto asked = [&] { return bench.driver.report(); };
  const auto report = testing::await_answer(
      asked, [](const nlohmann::json& now) { return now["other_senders"] > 20; });
  bench.driver.close();
  EXPECT_EQ(bench.match().size(), bench.sink.samples().size()) << "none of the second";
  EXPECT_EQ(
      report["trouble"].get<std::string>().find("two senders of poses of `robot`, 127.0.0.1:"), 0U)
      << report;
}

TEST(UdpPose, SilenceIsReportedAndEnds) {
  PoseBench bench({}, {{"lost_after_s", 0.2}});
  bench.sink.await_more(1);
  bench.peer->tell("mute");
  const std::string why = bench.sink.await_failure();
  EXPECT_EQ(
      why, "no pose of `robot` on UDP port " + bench.driver.report()["port"].dump() + " for 0.2 s");
  bench.peer->tell("speak");
  bench.sink.await_more(3);
  bench.sink.await_recovery();
  bench.peer->tell("restart");
  bench.sink.await_more(20);
  bench.driver.close();
  EXPECT_EQ(bench.driver.report()["restarts"], 1);
}

TEST(UdpPose, WithoutAThreadIsAnErrorAndOpensLater) {
  testing::LiveDriver driver("udp_pose");
  testing::LiveSink<PoseReading> sink(ReadingKind::kPose, 1);
  ASSERT_EQ(driver.configure({{"body", "robot"}, {"port", 0.0}}), "");
  {
    const base_testing::NoThreads none;
    EXPECT_EQ(driver.open(sink).find("cannot start the thread of the pose stream: "), 0U);
  }
  EXPECT_EQ(driver.open(sink), "");
  driver.close();
}

TEST(UdpPose, SaysWhatIsWrong) {
  testing::LiveDriver first("udp_pose");
  EXPECT_EQ(first.configure({{"body", "a"}, {"listen", "here"}}),
            "`listen` must be a numeric address such as 127.0.0.1, not `here`");
  EXPECT_EQ(first.configure({{"body", ""}}), "`body` is empty");
  testing::LiveSink<PoseReading> sink(ReadingKind::kPose, 1);
  EXPECT_EQ(first.open(sink), "opened before it was configured");
  ASSERT_EQ(first.configure({{"body", "a"}}), "");
  const double port = first.report()["port"].get<double>();
  testing::LiveDriver second("udp_pose");
  EXPECT_EQ(second.configure({{"body", "a"}, {"port", port}}),
            "cannot listen on UDP port " + first.report()["port"].dump() +
                " of 127.0.0.1: Address already in use");
}

}  // namespace
}  // namespace rave::udp_pose
