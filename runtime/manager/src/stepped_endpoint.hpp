// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "manager_endpoint.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/protocol/step_messages.hpp"
#include "seats.hpp"

namespace rave::manager {

/// What the manager of a run in lock-step does with the bus. Belongs to one thread.
class SteppedEndpoint {
 public:
  /// `begin_wish` and `on_command` may be empty: nobody on the bus can ask anything. Errors: those
  /// of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<SteppedEndpoint>> open(const bus::BusConfig& config,
                                                                     lock_step::Identity identity,
                                                                     LogSink* log,
                                                                     bus::BeginWish begin_wish,
                                                                     bus::OnCommand on_command);

  /// Sleeps until something has come, the time is over or `stop` is set.
  void wait(Duration timeout, const std::stop_token& stop = {}) {
    endpoint_->wait(waits_, step_, timeout, stop);
  }
  /// What it has in common with the managers of other runs.
  [[nodiscard]] ManagerEndpoint& endpoint() noexcept { return *endpoint_; }
  /// Whether a process said who it is, and fits.
  [[nodiscard]] bool knows(std::uint64_t writer) const {
    return endpoint_->host_of(writer).has_value();
  }

  /// Calls visit(const bus::HostReport&) for all that has come.
  template <class Visit>
  void take_reports(Visit&& visit) {
    reports_.take(std::forward<Visit>(visit));
  }
  /// Reads what a host hands over of the manager before into `world` and `authority` if it is newer
  /// than what is there; returns whether it was.
  bool take_last_world(sim::WorldStep& world, sim::AuthorityState& authority, bool has_one);
  void refuse(const bus::HostReport& report, std::string_view why) { reports_.refuse(report, why); }

  /// Sends a step of the world, and remembers it for resend(). Errors: kInvalidArgument (larger
  /// than the bus carries).
  Status send(const sim::WorldStep& world, const sim::AuthorityState& authority,
              const std::vector<Seat>& seats);
  /// Sends the last one again, for a host that has not got it.
  void resend(const std::vector<Seat>& seats);

 private:
  struct Parts;
  Status write(const std::vector<Seat>& seats);
  explicit SteppedEndpoint(Parts parts);

  std::unique_ptr<ManagerEndpoint> endpoint_;
  bus::Writer<bus::WorldStep> worlds_;
  bus::Reader<bus::HostReport> reports_;
  bus::Reader<bus::LastWorld> last_worlds_;
  bus::WaitSet waits_;  ///< Behind all that it waits for.
  lock_step::WorldMessage message_;
  bus::LastWorld* sent_ = nullptr;  ///< In `message_`.
  std::vector<std::uint64_t> writers_;
  std::uint64_t epoch_;
  std::uint64_t step_ = 0;  ///< That was sent last.
};

}  // namespace rave::manager
