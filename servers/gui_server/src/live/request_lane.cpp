// SPDX-License-Identifier: Apache-2.0
#include "live/request_lane.hpp"

#include <chrono>

#include "rave/base/thread.hpp"

namespace rave::gui_server {
namespace {

/// How often a lane without requests looks who has come and gone.
constexpr std::chrono::milliseconds kLook{500};

}  // namespace

Result<std::unique_ptr<RequestLane>> RequestLane::open(const bus::BusConfig& config) {
  RAVE_TRY_ASSIGN(auto bus, control::BusRun::open(config, "GUI Server"));
  std::unique_ptr<RequestLane> lane(new RequestLane(std::move(bus)));
  RequestLane* const self = lane.get();
  RAVE_TRY(start_thread(lane->thread_, "requests of pages",
                        [self](const std::stop_token& stop) { self->work(stop); }));
  return lane;
}

RequestLane::~RequestLane() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

std::future<RequestLane::Answer> RequestLane::queue(Work work) {
  const std::lock_guard lock(mutex_);
  auto& [waits, promise] = waiting_.emplace_back(std::move(work), std::promise<Answer>());
  auto answer = promise.get_future();
  changed_.notify_all();
  return answer;
}

void RequestLane::work(const std::stop_token& stop) {
  for (;;) {
    std::unique_lock lock(mutex_);
    const bool asked = changed_.wait_for(lock, stop, kLook, [this] { return !waiting_.empty(); });
    if (stop.stop_requested()) break;
    if (!asked) {
      lock.unlock();
      static_cast<void>(bus_->all(Duration{}));
      continue;
    }
    auto [carry_out, promise] = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    promise.set_value(carry_out(*bus_));
  }
  const std::lock_guard lock(mutex_);
  for (auto& [carry_out, promise] : waiting_) {
    promise.set_value(fail(ErrorCode::kState, "the server is shutting down"));
  }
}

}  // namespace rave::gui_server
