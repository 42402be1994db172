// SPDX-License-Identifier: Apache-2.0
#include "bus_endpoint.hpp"

namespace rave::manager {

Result<std::unique_ptr<BusEndpoint>> BusEndpoint::open(const ManagerRunOptions& options) {
  bus::BusConfig own = options.bus;
  // The manager has a partition and reserved ports of its own, so hosts of a large run need to look
  // for it alone.
  own.side = bus::Side::kManager;
  std::unique_ptr<BusEndpoint> made(new BusEndpoint(options.identity, options.log));
  RAVE_TRY_ASSIGN(made->bus_, bus::Bus::open(own));
  bus::Bus& bus = *made->bus_;
  RAVE_TRY(bus::open_all(bus, made->states_, made->own_info_, made->infos_, made->roster_,
                         made->host_results_));
  RAVE_TRY(made->pulse_.open(bus, made->identity_));
  RAVE_TRY_ASSIGN(made->requests_,
                  bus::RequestBox::create(bus, options.begin_request, options.log));
  return made;
}

Status BusEndpoint::wake(bus::WaitSet& waits) {
  RAVE_TRY(host_results_.wake(waits));
  return requests_ ? requests_->wake(waits) : Status();
}

Status BusEndpoint::wake_for_processes(bus::WaitSet& waits) {
  RAVE_TRY(waits.add(infos_));
  return waits.add_events();
}

// Called last, when all readers exist: hosts begin to send as soon as they have read it.
Status BusEndpoint::introduce() { return own_info_.write(introduced_); }

/// Admits a process that introduces itself.
void BusEndpoint::meet(const bus::HostInfo& info, bool begun) {
  if (info.host == rave_wire_kNone) {
    // A run has one manager. Of two that start at once the later one goes; one that serves a run
    // already stays, whatever its start time.
    const bool yields = !begun && lock_step::gives_way(introduced_, info);
    second_ = second_ || yields;
    if (!yields) foreign_.write(LogLevel::kWarning, kSource, not_listened_to(info));
    return;
  }
  if (const Status fits = lock_step::check_fits(identity_, info); !fits) {
    log_fault("refused: " + fits.error().message);
    return;
  }
  host_of_[info.writer] = info.host;
}

Result<std::vector<std::uint64_t>> BusEndpoint::look_at_processes(bool begun) {
  std::vector<std::uint64_t> gone;
  for (const bus::BusEvent& event : bus_->take_events()) {
    using enum bus::EventKind;
    if (event.kind == kParticipantLost && event.writer != 0) {
      // What else a loss means differs between lock-step and real time.
      host_of_.erase(event.writer);
      gone.push_back(event.writer);
      continue;
    }
    // Before the start a standstill costs nothing, because no host depends on worlds yet.
    if (event.kind == kStoodStill && begun) ++standstills_;
    foreign_.note(event);
  }
  // After the losses: a process that was cut off and is there again introduces itself anew.
  infos_.take([&](const bus::HostInfo& info) { meet(info, begun); });
  if (second_) {
    return fail(ErrorCode::kState,
                "this run has an environment manager already; to start a second run of the same "
                "scenario, give each its own name with --run");
  }
  return gone;
}

std::optional<std::uint32_t> BusEndpoint::host_of(std::uint64_t writer) const {
  const auto found = host_of_.find(writer);
  if (found == host_of_.end()) return std::nullopt;
  return found->second;
}

}  // namespace rave::manager
