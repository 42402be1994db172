// SPDX-License-Identifier: Apache-2.0
#include "switchboard.hpp"

#include "manager_habits.hpp"
#include "rave/bus/run_id.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::manager {
struct Switchboard::Parts {
  lock_step::Identity identity;
  LogSink* log;
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::WorldStep> worlds;
  bus::Writer<bus::RunState> states;
  bus::Writer<bus::HostInfo> own_info;
  bus::Reader<bus::HostReport> reports;
  bus::Reader<bus::LastWorld> last_worlds;
  bus::Reader<bus::HostInfo> infos;
  bus::Reader<bus::RosterEntry> roster;
  std::unique_ptr<bus::WishBox> wishes;
  bus::WaitSet waits;
  bus::HostInfo introduced;
  lock_step::Pulse pulse;
  lock_step::FindingsCollector findings;
};

Switchboard::Switchboard(Parts parts)
    : identity_(std::move(parts.identity)),
      foreign_(parts.log),
      bus_(std::move(parts.bus)),
      worlds_(std::move(parts.worlds)),
      states_(std::move(parts.states)),
      own_info_(std::move(parts.own_info)),
      reports_(std::move(parts.reports)),
      last_worlds_(std::move(parts.last_worlds)),
      infos_(std::move(parts.infos)),
      roster_(std::move(parts.roster)),
      wishes_(std::move(parts.wishes)),
      waits_(std::move(parts.waits)),
      introduced_(parts.introduced),
      epoch_(bus::random_writer_id()),
      pulse_(std::move(parts.pulse)),
      findings_(std::move(parts.findings)) {}

Result<std::unique_ptr<Switchboard>> Switchboard::open(const bus::BusConfig& config,
                                                       lock_step::Identity identity, LogSink* log,
                                                       bus::BeginWish begin_wish) {
  RAVE_TRY_ASSIGN(auto bus, bus::Bus::open(config));
  RAVE_TRY_ASSIGN(auto worlds, bus::Writer<bus::WorldStep>::create(*bus));
  RAVE_TRY_ASSIGN(auto states, bus::Writer<bus::RunState>::create(*bus));
  RAVE_TRY_ASSIGN(auto own_info, bus::Writer<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto reports, bus::Reader<bus::HostReport>::create(*bus));
  RAVE_TRY_ASSIGN(auto last_worlds, bus::Reader<bus::LastWorld>::create(*bus));
  RAVE_TRY_ASSIGN(auto infos, bus::Reader<bus::HostInfo>::create(*bus));
  RAVE_TRY_ASSIGN(auto roster, bus::Reader<bus::RosterEntry>::create(*bus));
  RAVE_TRY_ASSIGN(auto wishes, bus::WishBox::create(*bus, std::move(begin_wish), log));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(*bus));
  RAVE_TRY(waits.add(reports));
  RAVE_TRY(waits.add(last_worlds));
  RAVE_TRY(waits.add(infos));
  if (wishes) RAVE_TRY(wishes->wake(waits));
  RAVE_TRY_ASSIGN(auto findings, lock_step::FindingsCollector::create(*bus));
  RAVE_TRY(findings.wake(waits));
  RAVE_TRY(waits.add_events());
  RAVE_TRY_ASSIGN(auto pulse, lock_step::Pulse::create(*bus, identity));
  bus::HostInfo info = introduction(identity);
  RAVE_TRY(own_info.write(info));
  return std::unique_ptr<Switchboard>(new Switchboard(
      {std::move(identity), log, std::move(bus), std::move(worlds), std::move(states),
       std::move(own_info), std::move(reports), std::move(last_worlds), std::move(infos),
       std::move(roster), std::move(wishes), std::move(waits), info, std::move(pulse),
       std::move(findings)}));
}

Result<std::vector<std::uint64_t>> Switchboard::look_at_processes(bool begun) {
  infos_.take([&](const bus::HostInfo& info) {
    if (info.host == rave_wire_kNone) {
      const bool goes = !begun && lock_step::gives_way(introduced_, info);
      second_ = second_ || goes;
      if (!goes) foreign_.write(LogLevel::kWarning, kSource, not_listened_to(info));
      return;
    }
    const Status fits = check_fits(identity_, info);
    if (fits) {
      fitting_.insert(info.writer);
    } else {
      foreign_.write(LogLevel::kError, kSource, "refused: " + fits.error().message);
    }
  });
  if (second_) {
    return fail(ErrorCode::kState,
                "this run has an environment manager already; to start another run of the same "
                "scenario beside it, give both a name of their own with --run");
  }
  std::vector<std::uint64_t> gone;
  for (const bus::BusEvent& event : bus_->take_events()) {
    using enum bus::EventKind;
    if (event.kind == kParticipantLost && event.writer != 0) {
      gone.push_back(event.writer);
      continue;
    }
    foreign_.note(event);
  }
  return gone;
}

bool Switchboard::take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
                                  bool has_one) {
  bool newer = false;
  last_worlds_.take([&](const bus::LastWorld& sample) {
    if (!knows(sample.writer) || ((has_one || newer) && sample.step <= world.step)) return;
    sim::WorldStep handed;
    sim::AuthorityState state;
    if (auto status = lock_step::read(sample, handed, state); !status) {
      last_worlds_.refuse(sample, status.error().message);
      return;
    }
    world = std::move(handed);
    authority = std::move(state);
    newer = true;
  });
  return newer;
}

Status Switchboard::send(const sim::WorldStep& world, const sim::AuthorityState& authority,
                         const std::vector<Seat>& seats) {
  sent_ = nullptr;
  RAVE_TRY_ASSIGN(sent_, message_.fill(world, authority, epoch_));
  step_ = world.step;
  return write(seats);
}

Status Switchboard::write(const std::vector<Seat>& seats) {
  writers_.clear();
  for (const Seat& seat : seats) writers_.push_back(seat.writer);
  message_.address(writers_);
  return worlds_.write(*sent_);
}

void Switchboard::resend(const std::vector<Seat>& seats) {
  if (sent_ != nullptr) static_cast<void>(write(seats));
}

}  // namespace rave::manager
