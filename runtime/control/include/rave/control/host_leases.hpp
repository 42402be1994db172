// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::runtime {

/// The command leases of the robots of a process: each belongs to one page of one user at a time.
/// Owned by the process that runs the robots. Uses wall time, passed by the caller. One thread.
class HostLeases {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;
  /// The lease of a driven robot ends this long after the last drive command or renewal;
  static constexpr std::chrono::seconds kAfterDrive{3};
  /// otherwise it ends this long after the last order.
  static constexpr std::chrono::minutes kAfterOrder{10};
  /// The name of the local terminal in messages.
  static constexpr std::string_view kTerminal = "terminal";

  enum class Use {
    kDrive,  ///< Acquires the lease for kAfterDrive.
    kOrder,  ///< Acquires it for kAfterOrder.
    kLook,   ///< Fails if another holds the lease; does not acquire it.
  };
  /// The sender of a request. An empty name means the local terminal, a super-user that acquires a
  /// lease only to drive.
  struct Person {
    std::string_view name;
    bool overrides = false;
    /// Id of the user's page; 0: none, such as a script.
    std::uint64_t page = 0;
  };
  /// A change of a robot's lease.
  struct Change {
    std::string robot;
    std::string before;  ///< The previous holder; empty: none.
    std::string after;
    bool driven = false;   ///< The robot was being driven.
    bool expired = false;  ///< It expired, without a request.
    friend bool operator==(const Change&, const Change&) = default;
  };

  /// Uses the lease for an order. Error kState: another user, who is named, or another page of the
  /// same user holds it.
  Status use(const std::string& robot, const Person& person, Use how, Time now);
  /// Acquires the lease; its holder extends it. Error kState: another holds it, and neither `force`
  /// nor the user's rights override that.
  Result<std::string> take(const std::string& robot, const Person& person, bool force, Time now);
  /// Passes the lease to `to`, or returns it if that is empty. If passed to a user, the first of
  /// their pages that uses it gets it. A page that closes passes its leases to its own user, so
  /// that its orders continue; leases of other pages stay, whatever rights the user has. Errors:
  /// kState (another holds it), kInvalidArgument (no person holds it, so it cannot be returned).
  Result<std::string> give(const std::string& robot, const Person& person, const std::string& to,
                           Time now);
  /// The robot is no longer driven, so the lease lasts for kAfterOrder.
  void drive_ended(const std::string& robot, Time now);
  /// Ends the expired leases.
  void expire(Time now);
  /// The holder of a robot's lease; empty: none.
  [[nodiscard]] const std::string& holder(const std::string& robot) const noexcept;
  /// The page of the holder; 0: no particular one.
  [[nodiscard]] std::uint64_t page(const std::string& robot) const noexcept;
  [[nodiscard]] bool any() const noexcept { return !leases_.empty(); }
  /// The changes since the last call, in order.
  [[nodiscard]] std::vector<Change> take_changes();

 private:
  struct Lease {
    std::string holder;
    std::uint64_t page = 0;  ///< 0: the next page of the holder that uses it.
    Time until;
    bool driven = false;
  };
  [[nodiscard]] const Lease* find(const std::string& robot) const noexcept;
  [[nodiscard]] static bool owns(const Lease& lease, const Person& person) noexcept;
  /// The error for a user who does not hold the lease.
  [[nodiscard]] static tl::unexpected<Error> refusal(const std::string& robot, const Lease& lease,
                                                     const Person& person);
  void set(const std::string& robot, const Person& holder, bool driven, Time now);

  std::map<std::string, Lease, std::less<>> leases_;
  std::vector<Change> changes_;
};

/// A change of a lease in words: `anna` drives.
[[nodiscard]] std::string lease_text(const HostLeases::Change& change);

}  // namespace rave::runtime
