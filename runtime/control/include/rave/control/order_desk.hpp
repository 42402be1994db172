// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/drive_watch.hpp"
#include "rave/control/held_sticks.hpp"
#include "rave/control/host_leases.hpp"
#include "rave/control/run_control.hpp"

namespace rave::runtime {

/// The entry point for orders of users: it checks lease and rate, and ends orders (dead-man's
/// switch, end of a lease). Accepted orders become inputs of the run; it does not know the engine.
/// Wall time is passed by the caller. Thread: that of the run.
class OrderDesk {
 public:
  using Time = HostLeases::Time;
  /// Largest number of orders for one robot per second of wall time; also the burst limit.
  static constexpr double kMostInSecond = 100;

  /// Makes an input of the run from a request.
  using Give = std::function<Result<std::string>(const request::Request&)>;
  /// Whether a user drives the robot according to the run; a stop ends that.
  using IsDriven = std::function<bool(const std::string& robot)>;

  /// Whether a request must pass the desk: orders, leases, and releases and hand-overs, which need
  /// the lease.
  [[nodiscard]] static bool is_for(const request::Action& action) noexcept;
  /// Executes or refuses such a request. The robot that it names must exist.
  Result<std::string> serve(const request::Request& request, const Give& give,
                            const IsDriven& is_driven, Time now);
  /// Ends orders that were not renewed, by inputs through `give`. No cost while no person drives.
  void tick(const Give& give, Time now);
  /// Whether anything may expire.
  [[nodiscard]] bool waits() const noexcept { return leases_.any() || watch_.any(); }
  /// Whether a drive may have to be ended soon, within DriveWatch::kSilence.
  [[nodiscard]] bool drives() const noexcept { return watch_.any(); }
  [[nodiscard]] const std::string& holder(const std::string& robot) const noexcept {
    return leases_.holder(robot);
  }
  /// The page of the holder; 0: no particular one.
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
  Status check_release(const request::Request& request, Time now);
  /// Takes or gives the lease, or calls order().
  Result<std::string> carry_out(const request::Request& request, const Give& give,
                                const IsDriven& is_driven, Time now);
  Result<std::string> order(const request::Request& request, const Give& give,
                            const IsDriven& is_driven, Time now);
  Result<std::string> drive(const request::Request& request, const request::Drive& velocity,
                            const Give& give, const IsDriven& is_driven, Time now);
  /// Whether the velocity of a drive counts. Error kState: its stick is held.
  Result<HeldSticks::Use> look_at_stick(const request::Request& drive, const IsDriven& is_driven,
                                        Time now);
  /// The answer to a refused request. The stick of a drive is held then.
  tl::unexpected<Error> refused(const request::Request& request, Error why, Time now);
  /// Applies changes of leases: the previous holder stops driving.
  void follow_leases(const Give& give);

  HostLeases leases_;
  DriveWatch watch_;
  HeldSticks sticks_;
  std::map<std::string, Bucket, std::less<>> rates_;
  /// By robot: the author of its present order.
  std::map<std::string, std::string, std::less<>> ordered_;
  std::vector<HostLeases::Change> told_;
};

}  // namespace rave::runtime
