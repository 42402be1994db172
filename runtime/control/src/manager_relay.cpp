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

ManagerRelay::~ManagerRelay() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

std::future<Result<Answer>> ManagerRelay::post(Request request) {
  request.relay = false;
  const std::lock_guard lock(mutex_);
  auto& [asked, promise] =
      waiting_.emplace_back(std::move(request), std::promise<Result<Answer>>());
  auto answer = promise.get_future();
  if (!thread_.joinable()) {
    Status started = start_thread(thread_, "requests to the manager",
                                  [this](const std::stop_token& stop) { work(stop); });
    if (!started) {
      promise.set_value(tl::unexpected(std::move(started).error()));
      waiting_.pop_back();
    }
  }
  changed_.notify_all();
  return answer;
}

void ManagerRelay::work(const std::stop_token& stop) {
  bus::BusConfig config = config_;
  config.side = bus::Side::kManager;
  config.beside = true;
  std::unique_ptr<BusRun> bus;
  for (;;) {
    std::unique_lock lock(mutex_);
    const bool asked = changed_.wait_for(lock, stop, kLook, [this] { return !waiting_.empty(); });
    if (stop.stop_requested()) break;
    if (!asked) {
      lock.unlock();
      if (bus) static_cast<void>(bus->all(Duration{}));
      continue;
    }
    auto [request, promise] = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    promise.set_value(ask_manager(config, bus, request));
  }
  const std::lock_guard lock(mutex_);
  for (auto& [request, promise] : waiting_) {
    promise.set_value(fail(ErrorCode::kState, "the host has ended"));
  }
}

}  // namespace rave::control
