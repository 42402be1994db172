// SPDX-License-Identifier: Apache-2.0
#include "bus_endpoint.hpp"

namespace rave::manager {

struct BusEndpoint::Parts {
  lock_step::Identity identity;
  LogSink* log;
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::RunState> states;
  bus::Writer<bus::HostInfo> own_info;
  bus::Reader<bus::HostInfo> infos;
  bus::Reader<bus::RosterEntry> roster;
  std::unique_ptr<bus::RequestBox> requests;
  lock_step::Pulse pulse;
  lock_step::HostResultsCollector host_results;
};

BusEndpoint::BusEndpoint(Parts parts)
    : identity_(std::move(parts.identity)),
      foreign_(parts.log),
      bus_(std::move(parts.bus)),
      states_(std::move(parts.states)),
      own_info_(std::move(parts.own_info)),
      infos_(std::move(parts.infos)),
      roster_(std::move(parts.roster)),
      requests_(std::move(parts.requests)),
      pulse_(std::move(parts.pulse)),
      host_results_(std::move(parts.host_results)),
      introduced_(lock_step::introduction(identity_)) {}

Result<std::unique_ptr<BusEndpoint>> BusEndpoint::open(const bus::BusConfig& config,
                                                       lock_step::Identity identity, LogSink* log,
                                                       bus::BeginRequest begin_request) {
  bus::BusConfig own = config;
  // The manager has a partition and reserved ports of its own, so hosts of a large run need to look
  // for it alone.
  own.side = bus::Side::kManager;
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(own));
  RAVE_TRY_ASSIGN(auto states, bus::Writer<bus::RunState>::create(*bus));
  RAVE_TRY_ASSIGN(auto own_info, bus::Writer<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto roster, bus::Reader<bus::RosterEntry>::create(*bus));
  RAVE_TRY_ASSIGN(auto requests, bus::RequestBox::create(*bus, std::move(begin_request), log));
  RAVE_TRY_ASSIGN(auto pulse, lock_step::Pulse::create(*bus, identity));
  RAVE_TRY_ASSIGN(auto host_results, lock_step::HostResultsCollector::create(*bus));
  return std::unique_ptr<BusEndpoint>(
      new BusEndpoint({std::move(identity), log, std::move(bus), std::move(states),
                       std::move(own_info), std::move(infos), std::move(roster),
                       std::move(requests), std::move(pulse), std::move(host_results)}));
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
    const bool goes = !begun && lock_step::gives_way(introduced_, info);
    second_ = second_ || goes;
    if (!goes) foreign_.write(LogLevel::kWarning, kSource, not_listened_to(info));
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
