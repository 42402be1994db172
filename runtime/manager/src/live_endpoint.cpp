// SPDX-License-Identifier: Apache-2.0
#include "live_endpoint.hpp"

#include <optional>
#include <utility>

#include "bus_endpoint.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"

namespace rave::manager {
namespace {

class LiveOnBus final : public LiveEndpoint {
 public:
  explicit LiveOnBus(std::unique_ptr<BusEndpoint> endpoint) : endpoint_(std::move(endpoint)) {}

  Status open() {
    bus::Bus& bus = endpoint_->bus();
    RAVE_TRY(bus::open_all(bus, worlds_, pongs_, obstacles_, pings_, states_));
    RAVE_TRY_ASSIGN(waits_, bus::WaitSet::create(bus));
    RAVE_TRY(waits_.add(pings_, states_));
    RAVE_TRY(endpoint_->wake(waits_));
    // After all readers exist, since hosts answer at once.
    return endpoint_->introduce();
  }
  void wait(Duration timeout, const std::stop_token& stop) override {
    endpoint_->wait(waits_, world_, timeout, stop);
  }
  ManagerEndpoint& common() noexcept override { return *endpoint_; }
  void take_pings(const std::function<void(const bus::ClockPing&)>& visit) override {
    pings_.take(visit);
  }
  // A lost answer costs one reading; the host asks again.
  void answer(bus::ClockPong& pong) override { static_cast<void>(pongs_.write(pong)); }
  void take_states(const std::function<void(const bus::HostState&)>& visit) override {
    states_.take(visit);
  }
  void refuse(const bus::HostState& state, std::string_view why) override {
    states_.refuse(state, why);
  }
  void send(bus::World& world) override {
    // A world that cannot be sent is not repeated, because the next one replaces it.
    static_cast<void>(worlds_.write(world));
    world_ = world.step;
  }
  Status send(bus::Obstacle& obstacle) override { return obstacles_.write(obstacle); }
  Status ask_for_handed() override {
    // A new reader receives all that hosts keep, also what came before they were known.
    return handed_.emplace().open(endpoint_->bus());
  }
  std::size_t take_handed(const std::function<void(const bus::LastObstacle&)>& visit) override {
    return handed_ ? handed_->take(visit) : 0;
  }
  void end_handing() override { handed_.reset(); }

 private:
  std::unique_ptr<BusEndpoint> endpoint_;
  bus::Writer<bus::World> worlds_;
  bus::Writer<bus::ClockPong> pongs_;
  bus::Writer<bus::Obstacle> obstacles_;
  bus::Reader<bus::ClockPing> pings_;
  bus::Reader<bus::HostState> states_;
  std::optional<bus::Reader<bus::LastObstacle>> handed_;  ///< Exists during a hand-over only.
  bus::WaitSet waits_;       ///< Declared after the readers that it refers to.
  std::uint64_t world_ = 0;  ///< Number of the last one sent.
};

}  // namespace

Result<std::unique_ptr<LiveEndpoint>> LiveEndpoint::open(const ManagerRunOptions& options) {
  RAVE_TRY_ASSIGN(auto endpoint, BusEndpoint::open(options));
  auto made = std::make_unique<LiveOnBus>(std::move(endpoint));
  RAVE_TRY(made->open());
  return made;
}

}  // namespace rave::manager
