// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/drive_watch.hpp"
#include "rave/control/host_leases.hpp"
#include "rave/control/run_control.hpp"

namespace rave::runtime {

/// Where orders of people come in: whether they may be given (lease, rate), and what ends them
/// (dead-man's handle, the end of a lease). What it lets through becomes inputs of the run; it
/// knows no engine. Wall time is the caller's. The thread of the run.
class OrderDesk {
 public:
  using Time = HostLeases::Time;
  /// Orders of one robot in a second of wall time, at most; as many may come at once.
  static constexpr double kMostInSecond = 100;

  /// Makes an input of the run of a request.
  using Give = std::function<Result<std::string>(const RunRequest&)>;
  /// Whether somebody drives a robot now, as far as the run knows: a stop ends that.
  using IsDriven = std::function<bool(const std::string& robot)>;

  /// Whether a request concerns the desk: orders and leases, and a release and a
  /// hand-over, which need the lease.
  [[nodiscard]] static bool is_for(RunRequest::Kind kind) noexcept;
  /// Does such a request, or refuses it. The robot that it names exists.
  Result<std::string> serve(const RunRequest& request, const Give& give, const IsDriven& is_driven,
                            Time now);
  /// Ends what nobody renews: gives its inputs to `give`. Costs nothing while nobody drives.
  void tick(const Give& give, Time now);
  /// Whether something may end by itself.
  [[nodiscard]] bool waits() const noexcept { return leases_.any() || watch_.any(); }
  [[nodiscard]] const std::string& holder(const std::string& robot) const noexcept {
    return leases_.holder(robot);
  }
  /// On which page of theirs; 0: on none in particular.
  [[nodiscard]] std::uint64_t page(const std::string& robot) const noexcept {
    return leases_.page(robot);
  }
  [[nodiscard]] std::vector<HostLeases::Change> take_changes() { return std::exchange(told_, {}); }

 private:
  struct Bucket {
    double left = kMostInSecond;
    Time since;
  };
  Status check_rate(const std::string& robot, Time now);
  Status check_release(const RunRequest& request, Time now);
  Result<std::string> order(const RunRequest& request, const Give& give, const IsDriven& is_driven,
                            Time now);
  Result<std::string> drive(const RunRequest& request, const Give& give, const IsDriven& is_driven,
                            Time now);
  /// What changed hands: the former holder drives no more.
  void follow_leases(const Give& give);

  HostLeases leases_;
  DriveWatch watch_;
  std::map<std::string, Bucket, std::less<>> rates_;
  std::map<std::string, std::string, std::less<>> ordered_;  ///< By robot: who gave its order.
  std::vector<HostLeases::Change> told_;
};

}  // namespace rave::runtime
