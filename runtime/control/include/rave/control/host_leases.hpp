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

/// Who may give the robots of a process orders: one page of one person at a time each. Owned by
/// the process that runs the robot, and kept by wall time, which the caller gives. One thread.
class HostLeases {
 public:
  using Clock = std::chrono::steady_clock;
  using Time = Clock::time_point;
  /// A lease ends so long after the last drive, or its renewal, of a robot that was being driven;
  static constexpr std::chrono::seconds kAfterDrive{3};
  /// and so long after the last order otherwise.
  static constexpr std::chrono::minutes kAfterOrder{10};
  /// What the terminal of this machine is called where people read it.
  static constexpr std::string_view kTerminal = "terminal";

  enum class Use {
    kDrive,  ///< Takes the lease, and keeps it for kAfterDrive.
    kOrder,  ///< Takes it, and keeps it for kAfterOrder.
    kLook,   ///< Needs it if somebody has it, and takes none.
  };
  /// Who asks. Without a name it is the terminal, a super-user that takes a lease only to drive.
  struct Person {
    std::string_view name;
    bool overrides = false;
    /// Which of the pages that the person has open; 0: none, as of a script.
    std::uint64_t page = 0;
  };
  /// What has become of the lease of a robot.
  struct Change {
    std::string robot;
    std::string before;  ///< Empty: nobody.
    std::string after;
    bool driven = false;   ///< It was being driven.
    bool expired = false;  ///< Nobody asked for that.
    friend bool operator==(const Change&, const Change&) = default;
  };

  /// Somebody gives an order. Error kState: another has the lease, who is named, or another page of
  /// the same person.
  Status use(const std::string& robot, const Person& person, Use how, Time now);
  /// Takes the lease; who has it keeps it longer. Error kState: another has it, and neither `force`
  /// nor the person's rights take it.
  Result<std::string> take(const std::string& robot, const Person& person, bool force, Time now);
  /// Gives it to `to`, or back if that is empty. To a person is to any page of theirs: the first
  /// that uses it has it. To oneself is what a page does that goes: what it asked for goes on, and
  /// what is not that page's stays as it is, whatever rights the person has.
  /// Errors: kState (another has it), kInvalidArgument (nobody has it, so nothing can be given
  /// back).
  Result<std::string> give(const std::string& robot, const Person& person, const std::string& to,
                           Time now);
  /// The robot is not driven any more, so the lease holds for kAfterOrder.
  void drive_ended(const std::string& robot, Time now);
  /// Ends the leases whose time is over.
  void expire(Time now);
  /// Who has the lease of a robot; empty: nobody.
  [[nodiscard]] const std::string& holder(const std::string& robot) const noexcept;
  /// On which page; 0: on none in particular.
  [[nodiscard]] std::uint64_t page(const std::string& robot) const noexcept;
  [[nodiscard]] bool any() const noexcept { return !leases_.empty(); }
  /// What happened since the last call, in order.
  [[nodiscard]] std::vector<Change> take_changes();

 private:
  struct Lease {
    std::string holder;
    std::uint64_t page = 0;  ///< 0: whichever page of the holder uses it next.
    Time until;
    bool driven = false;
  };
  [[nodiscard]] const Lease* find(const std::string& robot) const noexcept;
  [[nodiscard]] static bool owns(const Lease& lease, const Person& person) noexcept;
  /// Why a person has to leave the robot alone.
  [[nodiscard]] static tl::unexpected<Error> refusal(const std::string& robot, const Lease& lease,
                                                     const Person& person);
  void set(const std::string& robot, const Person& holder, bool driven, Time now);

  std::map<std::string, Lease, std::less<>> leases_;
  std::vector<Change> changes_;
};

/// What has become of a lease, for people: `anna` drives.
[[nodiscard]] std::string lease_text(const HostLeases::Change& change);

}  // namespace rave::runtime
