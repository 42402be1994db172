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

struct LiveParts {
  std::unique_ptr<BusEndpoint> endpoint;
  bus::Writer<bus::World> worlds;
  bus::Writer<bus::ClockPong> pongs;
  bus::Writer<bus::Obstacle> obstacles;
  bus::Reader<bus::ClockPing> pings;
  bus::Reader<bus::HostState> states;
  std::optional<bus::Reader<bus::LastObstacle>> handed{};  ///< Exists during a hand-over only.
  bus::WaitSet waits;                                      ///< Behind all that it waits for.
};

class LiveOnBus final : public LiveEndpoint {
 public:
  explicit LiveOnBus(LiveParts parts) : parts_(std::move(parts)) {}

  void wait(Duration timeout, const std::stop_token& stop) override {
    parts_.endpoint->wait(parts_.waits, world_, timeout, stop);
  }
  ManagerEndpoint& common() noexcept override { return *parts_.endpoint; }
  void take_pings(const std::function<void(const bus::ClockPing&)>& visit) override {
    parts_.pings.take(visit);
  }
  // A lost answer costs one reading; the host asks again.
  void answer(bus::ClockPong& pong) override { static_cast<void>(parts_.pongs.write(pong)); }
  void take_states(const std::function<void(const bus::HostState&)>& visit) override {
    parts_.states.take(visit);
  }
  void refuse(const bus::HostState& state, std::string_view why) override {
    parts_.states.refuse(state, why);
  }
  void send(bus::World& world) override {
    // A world that cannot be sent is not repeated, because the next one replaces it.
    static_cast<void>(parts_.worlds.write(world));
    world_ = world.step;
  }
  Status send(bus::Obstacle& obstacle) override { return parts_.obstacles.write(obstacle); }
  Status ask_for_handed() override {
    // A new reader receives all that hosts keep, also what came before they were known.
    parts_.handed.reset();
    RAVE_TRY_ASSIGN(auto reader, bus::Reader<bus::LastObstacle>::create(parts_.endpoint->bus()));
    parts_.handed.emplace(std::move(reader));
    return {};
  }
  std::size_t take_handed(const std::function<void(const bus::LastObstacle&)>& visit) override {
    return parts_.handed ? parts_.handed->take(visit) : 0;
  }
  void end_handing() override { parts_.handed.reset(); }

 private:
  LiveParts parts_;
  std::uint64_t world_ = 0;  ///< Number of the last one sent.
};

}  // namespace

Result<std::unique_ptr<LiveEndpoint>> LiveEndpoint::open(const LiveManagerOptions& options) {
  RAVE_TRY_ASSIGN(auto endpoint, BusEndpoint::open(options.bus, options.identity, options.log,
                                                   options.begin_request));
  bus::Bus& bus = endpoint->bus();
  RAVE_TRY_ASSIGN(auto worlds, bus::Writer<bus::World>::create(bus));
  RAVE_TRY_ASSIGN(auto pongs, bus::Writer<bus::ClockPong>::create(bus));
  RAVE_TRY_ASSIGN(auto obstacles, bus::Writer<bus::Obstacle>::create(bus));
  RAVE_TRY_ASSIGN(auto pings, bus::Reader<bus::ClockPing>::create(bus));
  RAVE_TRY_ASSIGN(auto states, bus::Reader<bus::HostState>::create(bus));
  RAVE_TRY_ASSIGN(auto waits, bus::WaitSet::create(bus));
  RAVE_TRY(waits.add(pings));
  RAVE_TRY(waits.add(states));
  RAVE_TRY(endpoint->wake(waits));
  // After all readers exist, since hosts answer at once.
  RAVE_TRY(endpoint->introduce());
  return std::make_unique<LiveOnBus>(
      LiveParts{std::move(endpoint), std::move(worlds), std::move(pongs), std::move(obstacles),
                std::move(pings), std::move(states), std::nullopt, std::move(waits)});
}

}  // namespace rave::manager
