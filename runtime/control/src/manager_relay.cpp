// SPDX-License-Identifier: Apache-2.0
#include "rave/control/manager_relay.hpp"

#include <chrono>
#include <memory>

#include "rave/base/thread.hpp"
#include "rave/control/bus_run.hpp"

namespace rave::control {
namespace {

/// Together less than who asked the host waits for its answer.
constexpr Duration kSearchPatience = from_seconds(1);
constexpr Duration kAnswerPatience = from_seconds(3);
/// How often a relay without requests looks who has come and gone.
constexpr std::chrono::milliseconds kLook{500};

/// Asks the manager, on a bus that is opened when it is first needed.
Result<Answer> ask_manager(const bus::BusConfig& config, std::unique_ptr<BusRun>& bus,
                           const Request& request) {
  if (!bus) {
    RAVE_TRY_ASSIGN(bus, BusRun::open(config, config.participant));
  }
  RAVE_TRY_ASSIGN(const BusPeer manager, bus->find({}, kSearchPatience));
  return bus->ask(manager, request, kAnswerPatience);
}

}  // namespace

ManagerRelay::Lane::~Lane() {
  thread.request_stop();
  if (thread.joinable()) thread.join();
}

std::future<Result<Answer>> ManagerRelay::post(Request request) {
  request.relay = false;
  Lane& lane = request::is_hold(request.run.action) ? holds_ : others_;
  const std::lock_guard lock(lane.mutex);
  auto& [asked, promise] =
      lane.waiting.emplace_back(std::move(request), std::promise<Result<Answer>>());
  auto answer = promise.get_future();
  if (!lane.thread.joinable()) {
    Status started = start_thread(lane.thread, "requests to the manager",
                                  [this, &lane](const std::stop_token& stop) { work(lane, stop); });
    if (!started) {
      promise.set_value(tl::unexpected(std::move(started).error()));
      lane.waiting.pop_back();
    }
  }
  lane.changed.notify_all();
  return answer;
}

void ManagerRelay::work(Lane& lane, const std::stop_token& stop) const {
  bus::BusConfig config = config_;
  config.side = bus::Side::kManager;
  config.beside = true;
  std::unique_ptr<BusRun> bus;
  for (;;) {
    std::unique_lock lock(lane.mutex);
    const bool asked =
        lane.changed.wait_for(lock, stop, kLook, [&lane] { return !lane.waiting.empty(); });
    if (stop.stop_requested()) break;
    if (!asked) {
      lock.unlock();
      if (bus) static_cast<void>(bus->all(Duration{}));
      continue;
    }
    auto [request, promise] = std::move(lane.waiting.front());
    lane.waiting.pop_front();
    lock.unlock();
    promise.set_value(ask_manager(config, bus, request));
  }
  const std::lock_guard lock(lane.mutex);
  for (auto& [request, promise] : lane.waiting) {
    promise.set_value(fail(ErrorCode::kState, "the host has ended"));
  }
}

}  // namespace rave::control
