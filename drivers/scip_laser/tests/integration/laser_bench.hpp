// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "rave/live_testing/live_driver.hpp"
#include "rave/live_testing/live_sink.hpp"
#include "rave/live_testing/peer_process.hpp"

namespace rave::scip {

using testing::Given;

/// One line of the peer's log.
struct Sent {
  std::int64_t measured_ns = 0;  ///< CLOCK_MONOTONIC
  std::uint32_t timer_ms = 0;
  std::string fault;
  std::vector<float> ranges_m;  ///< As a right driver understands them.
};

/// A laser on the bench: the peer, a folder for its files, and the driver.
class LaserBench {
 public:
  explicit LaserBench(std::vector<std::string> options = {}, bool tcp = false)
      : folder_(std::filesystem::temp_directory_path() /
                ("scip_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
    options.insert(options.end(), {"--rpm", "2400", "--log", log_path()});
    options.emplace_back(tcp ? "--port" : "--link");
    options.push_back(tcp ? "0" : link());
    peer = std::make_unique<testing::PeerProcess>("peer_scip", options);
    if (tcp) {
      given["address"] = "127.0.0.1:" + peer->where();
    } else {
      given["device"] = link();
    }
  }
  ~LaserBench() {
    driver.close();
    peer.reset();
    std::filesystem::remove_all(folder_);
  }

  /// Configures and opens the driver, and waits for the first scan.
  void start() {
    ASSERT_EQ(driver.configure(given), "");
    sink = std::make_unique<testing::LiveSink<float>>(ReadingKind::kRanges,
                                                      driver.declaration().capacity);
    ASSERT_EQ(driver.open(*sink), "");
    sink->await_more(1);
  }

  [[nodiscard]] std::string link() const { return (folder_ / "laser").string(); }
  [[nodiscard]] std::string log_path() const { return (folder_ / "log").string(); }

  /// All that the peer measured; `two`: as two characters carry it.
  [[nodiscard]] std::vector<Sent> sent(bool two = false) const {
    std::vector<Sent> all;
    std::ifstream file(log_path());
    for (std::string line; std::getline(file, line) && !file.eof();) {
      std::istringstream words(line);
      Sent scan;
      std::int64_t number = 0;
      words >> number >> scan.measured_ns >> scan.timer_ms >> scan.fault;
      for (int mm = 0; words >> mm;) {
        if (two && mm > 4095) mm = 4095;
        scan.ranges_m.push_back(mm == 1 || mm > 5600 ? std::numeric_limits<float>::infinity()
                                                     : static_cast<float>(mm) * 1e-3F);
      }
      all.push_back(std::move(scan));
    }
    return all;
  }

  /// Every scan that was delivered is one that the peer measured, none came twice, and in order.
  /// The scans, each beside its sample.
  std::vector<const Sent*> match(const std::vector<Sent>& all,
                                 const std::vector<testing::Delivered<float>>& samples) const {
    std::vector<const Sent*> matched;
    std::size_t from = 0;
    for (const auto& sample : samples) {
      std::size_t i = from;
      while (i < all.size() && all[i].ranges_m != sample.records) ++i;
      if (i == all.size()) {
        ADD_FAILURE() << "scan " << matched.size() << " of " << samples.size()
                      << " was never measured, or came out of turn";
        return matched;
      }
      matched.push_back(&all[i]);
      from = i + 1;
    }
    return matched;
  }

  Given given;
  std::unique_ptr<testing::PeerProcess> peer;
  testing::LiveDriver driver{"scip_laser"};
  std::unique_ptr<testing::LiveSink<float>> sink;

 private:
  std::filesystem::path folder_;
};

}  // namespace rave::scip
