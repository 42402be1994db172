// SPDX-License-Identifier: Apache-2.0
#include "stepped_endpoint.hpp"

#include "bus_endpoint.hpp"
#include "rave/bus/run_id.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::manager {
namespace {

class SteppedOnBus final : public SteppedEndpoint {
 public:
  explicit SteppedOnBus(std::unique_ptr<BusEndpoint> endpoint) : endpoint_(std::move(endpoint)) {}
  Status open();

  void wait(Duration timeout, const std::stop_token& stop) override {
    endpoint_->wait(waits_, step_, timeout, stop);
  }
  ManagerEndpoint& endpoint() noexcept override { return *endpoint_; }
  void take_reports(const Visit& visit) override { reports_.take(visit); }
  bool take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
                       bool has_one) override;
  void refuse(const bus::HostReport& report, std::string_view why) override {
    reports_.refuse(report, why);
  }
  Status send(const sim::WorldStep& world, const sim::AuthorityState& authority,
              const std::vector<HostSlot>& slots) override;
  void resend(const std::vector<HostSlot>& slots) override {
    if (sent_ != nullptr) static_cast<void>(write(slots));
  }

 private:
  Status write(const std::vector<HostSlot>& slots);

  std::unique_ptr<BusEndpoint> endpoint_;
  bus::Writer<bus::WorldStep> worlds_;
  bus::Reader<bus::HostReport> reports_;
  bus::Reader<bus::LastWorld> last_worlds_;
  bus::WaitSet waits_;  ///< Declared after the readers that it refers to.
  lock_step::WorldMessage message_;
  bus::LastWorld* sent_ = nullptr;  ///< Points into `message_`.
  std::vector<std::uint64_t> writers_;
  std::uint64_t epoch_ = bus::random_writer_id();
  std::uint64_t step_ = 0;  ///< The last step that was sent.
};

Status SteppedOnBus::open() {
  bus::Bus& bus = endpoint_->bus();
  RAVE_TRY(bus::open_all(bus, worlds_, reports_, last_worlds_));
  RAVE_TRY_ASSIGN(waits_, bus::WaitSet::create(bus));
  RAVE_TRY(waits_.add(reports_, last_worlds_));
  RAVE_TRY(endpoint_->wake(waits_));
  RAVE_TRY(endpoint_->wake_for_processes(waits_));
  return endpoint_->introduce();
}

bool SteppedOnBus::take_last_world(sim::WorldStep& world, sim::AuthorityState& authority,
                                   bool has_one) {
  bool newer = false;
  last_worlds_.take([&](const bus::LastWorld& sample) {
    // The newest of all worlds is the one to continue from. Hosts may be one step apart, because a
    // lost manager may have reached only some of them.
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
  return worlds_.write(*sent_);
}

}  // namespace

Result<std::unique_ptr<SteppedEndpoint>> SteppedEndpoint::open(const ManagerRunOptions& options) {
  RAVE_TRY_ASSIGN(auto endpoint, BusEndpoint::open(options));
  auto made = std::make_unique<SteppedOnBus>(std::move(endpoint));
  RAVE_TRY(made->open());
  return made;
}

}  // namespace rave::manager
