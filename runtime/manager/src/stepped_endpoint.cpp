// SPDX-License-Identifier: Apache-2.0
#include "stepped_endpoint.hpp"

#include "rave/bus/run_id.hpp"
#include "rave/bus/sequence.hpp"

namespace rave::manager {

struct SteppedEndpoint::Parts {
  std::unique_ptr<ManagerEndpoint> endpoint;
  bus::Writer<bus::WorldStep> worlds;
  bus::Reader<bus::HostReport> reports;
  bus::Reader<bus::LastWorld> last_worlds;
  bus::WaitSet waits;
};

SteppedEndpoint::SteppedEndpoint(Parts parts)
    : endpoint_(std::move(parts.endpoint)),
      worlds_(std::move(parts.worlds)),
      reports_(std::move(parts.reports)),
      last_worlds_(std::move(parts.last_worlds)),
      waits_(std::move(parts.waits)),
      epoch_(bus::random_writer_id()) {}

Result<std::unique_ptr<SteppedEndpoint>> SteppedEndpoint::open(const bus::BusConfig& config,
                                                               lock_step::Identity identity,
                                                               LogSink* log,
                                                               bus::BeginWish begin_wish,
                                                               bus::OnCommand on_command) {
  RAVE_TRY_ASSIGN(auto endpoint,
                  ManagerEndpoint::open(config, std::move(identity), log, std::move(begin_wish),
                                        std::move(on_command)));
  bus::Bus& bus = endpoint->bus();
  RAVE_TRY_ASSIGN(auto worlds, bus::Writer<bus::WorldStep>::create(bus));
  RAVE_TRY_ASSIGN(auto reports, bus::Reader<bus::HostReport>::create(bus));
  RAVE_TRY_ASSIGN(auto last_worlds, bus::Reader<bus::LastWorld>::create(bus));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(bus));
  RAVE_TRY(waits.add(reports));
  RAVE_TRY(waits.add(last_worlds));
  RAVE_TRY(endpoint->wake(waits));
  RAVE_TRY(endpoint->wake_for_processes(waits));
  RAVE_TRY(endpoint->introduce());
  return std::unique_ptr<SteppedEndpoint>(
      new SteppedEndpoint({std::move(endpoint), std::move(worlds), std::move(reports),
                           std::move(last_worlds), std::move(waits)}));
}

bool SteppedEndpoint::take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
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

Status SteppedEndpoint::send(const sim::WorldStep& world, const sim::AuthorityState& authority,
                             const std::vector<Seat>& seats) {
  sent_ = nullptr;
  RAVE_TRY_ASSIGN(sent_, message_.fill(world, authority, epoch_));
  step_ = world.step;
  return write(seats);
}

Status SteppedEndpoint::write(const std::vector<Seat>& seats) {
  writers_.clear();
  for (const Seat& seat : seats) writers_.push_back(seat.writer);
  message_.address(writers_);
  return worlds_.write(*sent_);
}

void SteppedEndpoint::resend(const std::vector<Seat>& seats) {
  if (sent_ != nullptr) static_cast<void>(write(seats));
}

}  // namespace rave::manager
