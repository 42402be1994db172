// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>
#include <vector>

#include "host_slots.hpp"
#include "manager_endpoint.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/manager/manager_run_options.hpp"
#include "rave/sim/authority_state.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::manager {

/// The endpoint of a manager in lock-step. open() gives the real one; tests use others. Belongs to
/// one thread.
class SteppedEndpoint {
 public:
  using Visit = std::function<void(const bus::HostReport&)>;

  /// Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<SteppedEndpoint>> open(
      const ManagerRunOptions& options);
  virtual ~SteppedEndpoint() = default;

  /// Sleeps until a message arrives, the time has passed or `stop` is set.
  virtual void wait(Duration timeout, const std::stop_token& stop) = 0;
  /// The part that both kinds of run share.
  [[nodiscard]] virtual ManagerEndpoint& endpoint() noexcept = 0;
  /// Whether a process has introduced itself and fits this run.
  [[nodiscard]] bool knows(std::uint64_t writer) { return endpoint().host_of(writer).has_value(); }

  /// Calls `visit` for all reports that have arrived.
  virtual void take_reports(const Visit& visit) = 0;
  /// Reads the state of the previous manager, as a host hands it over, into `world` and `authority`
  /// if it is newer than their content; returns whether it was.
  virtual bool take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
                               bool has_one) = 0;
  virtual void refuse(const bus::HostReport& report, std::string_view why) = 0;

  /// Sends a step of the world, and remembers it for resend(). Errors: kInvalidArgument (larger
  /// than the bus carries).
  virtual Status send(const sim::WorldStep& world, const sim::AuthorityState& authority,
                      const std::vector<HostSlot>& slots) = 0;
  /// Sends the last step again to hosts that have not received it.
  virtual void resend(const std::vector<HostSlot>& slots) = 0;
};

}  // namespace rave::manager
