// SPDX-License-Identifier: Apache-2.0
#include "stepped_endpoint.hpp"

#include "bus_endpoint.hpp"
#include "rave/bus/run_id.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::manager {

namespace {

struct SteppedParts {
  std::unique_ptr<BusEndpoint> endpoint;
  bus::Writer<bus::WorldStep> worlds;
  bus::Reader<bus::HostReport> reports;
  bus::Reader<bus::LastWorld> last_worlds;
  bus::WaitSet waits;  ///< Declared last: it refers to the readers.
};

class SteppedOnBus final : public SteppedEndpoint {
 public:
  explicit SteppedOnBus(SteppedParts parts) : parts_(std::move(parts)) {}

  void wait(Duration timeout, const std::stop_token& stop) override {
    parts_.endpoint->wait(parts_.waits, step_, timeout, stop);
  }
  ManagerEndpoint& endpoint() noexcept override { return *parts_.endpoint; }
  void take_reports(const Visit& visit) override { parts_.reports.take(visit); }
  bool take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
                       bool has_one) override;
  void refuse(const bus::HostReport& report, std::string_view why) override {
    parts_.reports.refuse(report, why);
  }
  Status send(const sim::WorldStep& world, const sim::AuthorityState& authority,
              const std::vector<HostSlot>& slots) override;
  void resend(const std::vector<HostSlot>& slots) override {
    if (sent_ != nullptr) static_cast<void>(write(slots));
  }

 private:
  Status write(const std::vector<HostSlot>& slots);

  SteppedParts parts_;
  lock_step::WorldMessage message_;
  bus::LastWorld* sent_ = nullptr;  ///< Points into `message_`.
  std::vector<std::uint64_t> writers_;
  std::uint64_t epoch_ = bus::random_writer_id();
  std::uint64_t step_ = 0;  ///< The last step that was sent.
};

bool SteppedOnBus::take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
                                   bool has_one) {
  bool newer = false;
  parts_.last_worlds.take([&](const bus::LastWorld& sample) {
    // The newest of all worlds is the one to continue from. Hosts may be one step apart, because a
    // lost manager may have reached only some of them.
    if (!knows(sample.writer) || ((has_one || newer) && sample.step <= world.step)) return;
    sim::WorldStep handed;
    sim::AuthorityState state;
    if (auto status = lock_step::read(sample, handed, state); !status) {
      parts_.last_worlds.refuse(sample, status.error().message);
      return;
    }
    world = std::move(handed);
    authority = std::move(state);
    newer = true;
  });
  return newer;
}

Status SteppedOnBus::send(const sim::WorldStep& world, const sim::AuthorityState& authority,
                          const std::vector<HostSlot>& slots) {
  sent_ = nullptr;
  // The message is kept: a host that has missed it gets the same bytes again.
  RAVE_TRY_ASSIGN(sent_, message_.fill(world, authority, epoch_));
  step_ = world.step;
  return write(slots);
}

Status SteppedOnBus::write(const std::vector<HostSlot>& slots) {
  writers_.clear();
  // By host, the process that the world is for. A process that has lost its slot meanwhile must not
  // act on it.
  for (const HostSlot& slot : slots) writers_.push_back(slot.writer);
  message_.address(writers_);
  return parts_.worlds.write(*sent_);
}

}  // namespace

Result<std::unique_ptr<SteppedEndpoint>> SteppedEndpoint::open(const bus::BusConfig& config,
                                                               lock_step::Identity identity,
                                                               LogSink* log,
                                                               bus::BeginRequest begin_request) {
  RAVE_TRY_ASSIGN(auto endpoint,
                  BusEndpoint::open(config, std::move(identity), log, std::move(begin_request)));
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
  return std::make_unique<SteppedOnBus>(SteppedParts{std::move(endpoint), std::move(worlds),
                                                     std::move(reports), std::move(last_worlds),
                                                     std::move(waits)});
}

}  // namespace rave::manager
