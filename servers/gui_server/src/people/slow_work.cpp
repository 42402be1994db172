// SPDX-License-Identifier: Apache-2.0
#include "people/slow_work.hpp"

#include <chrono>

#include "rave/base/thread.hpp"

namespace rave::gui_server {

namespace {
constexpr std::size_t kMostOwn = 16;
constexpr std::size_t kMostOfQueue = 32;
constexpr std::size_t kMostOfQueues = 128;
}  // namespace

bool SlowWork::post(std::function<void()> call, const std::string& queue) {
  {
    const std::lock_guard lock(mutex_);
    if (ends_) return false;
    if (!thread_.joinable() && !start_thread(thread_, "slow work", [this] { run(); })) return false;
    if (queue.empty()) {
      if (own_.size() >= kMostOwn) return false;
      own_.push_back(std::move(call));
    } else {
      const auto found = queues_.find(queue);
      const bool full = found != queues_.end() && found->second.size() >= kMostOfQueue;
      if (full || waiting_ >= kMostOfQueues) return false;
      queues_[queue].push_back(std::move(call));
      ++waiting_;
    }
  }
  wake_.notify_one();
  return true;
}

void SlowWork::stop() {
  Calls dropped;
  std::map<std::string, Calls> dropped_queues;
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    dropped.swap(own_);
    dropped_queues.swap(queues_);
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

std::function<void()> SlowWork::next(std::unique_lock<std::mutex>& lock) {
  while (!ends_) {
    const auto now = TokenBucket::Clock::now();
    if (!own_.empty()) {
      auto call = std::move(own_.front());
      own_.pop_front();
      return call;
    }
    if (queues_.empty()) {
      wake_.wait(lock);
    } else if (!pace_.take(now)) {
      const double missing = 1 - pace_.tokens(now);
      wake_.wait_for(lock, std::chrono::duration<double>(missing / kCallsPerSecond));
    } else {
      // The one after that of the last turn, in the order of their names.
      auto turn = queues_.upper_bound(last_);
      if (turn == queues_.end()) turn = queues_.begin();
      last_ = turn->first;
      auto call = std::move(turn->second.front());
      turn->second.pop_front();
      if (turn->second.empty()) queues_.erase(turn);
      --waiting_;
      return call;
    }
  }
  return nullptr;
}

void SlowWork::run() {
  while (true) {
    std::function<void()> call;
    {
      std::unique_lock lock(mutex_);
      call = next(lock);
    }
    if (!call) return;
    call();
  }
}

}  // namespace rave::gui_server
