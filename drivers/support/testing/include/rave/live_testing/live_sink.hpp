// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <vector>

#include "rave/live_testing/peer_process.hpp"
#include "rave/robot/sample_queue.hpp"

namespace rave::testing {

/// A run that follows the wall clock, beginning with the construction of this object.
class WallClock final : public RunClock {
 public:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] SimTime now() const noexcept override { return at(Clock::now()); }
  [[nodiscard]] Clock::time_point wall_time_of(SimTime t) const noexcept override {
    return begin_ + std::chrono::nanoseconds(t.ns);
  }
  [[nodiscard]] SimTime at(Clock::time_point t) const noexcept { return {(t - begin_).count()}; }
  /// Like at(), for nanoseconds of CLOCK_MONOTONIC, as in logs of peers.
  [[nodiscard]] SimTime at_ns(std::int64_t t_ns) const noexcept {
    return at(Clock::time_point(std::chrono::nanoseconds(t_ns)));
  }

 private:
  Clock::time_point begin_ = Clock::now();
};

/// One sample as a host receives it, and the time when the driver published it.
template <class Record>
struct Delivered {
  SimTime stamp;
  SimTime published;
  std::vector<Record> records;
};

/// The host's queue with notifications, so that a test can wait for samples.
template <class Record>
class LiveSink final : public SampleSink {
 public:
  LiveSink(ReadingKind kind, std::uint32_t capacity)
      : capacity_(capacity), queue_(kind, capacity, 256, &clock_) {}

  bool wait_until(SimTime t) noexcept override { return queue_.wait_until(t); }
  bool publish(SimTime stamp, const void* records, std::uint32_t count) noexcept override {
    const bool open = queue_.publish(stamp, records, count);
    const SimTime now = clock_.now();
    const std::lock_guard lock(mutex_);
    SampleHeader header;
    std::vector<Record> taken(capacity_);
    while (queue_.next(now, &header, taken.data())) {
      samples_.push_back({{header.stamp_ns}, now, {taken.begin(), taken.begin() + header.count}});
    }
    changed_.notify_all();
    return open;
  }
  void complete_up_to(SimTime t) noexcept override { queue_.complete_up_to(t); }
  void fail(const char* text, std::uint64_t size) noexcept override {
    queue_.fail(text, size);
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
  }
  void recover() noexcept override {
    queue_.recover();
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
  }
  void begin_anew(const char* text, std::uint64_t size) noexcept override {
    queue_.begin_anew(text, size);
    const std::lock_guard lock(mutex_);
    changed_.notify_all();
  }
  [[nodiscard]] SimTime now() const noexcept override { return queue_.now(); }

  /// Waits for `count` further samples.
  void await_more(std::size_t count) {
    std::unique_lock lock(mutex_);
    const std::size_t wanted = samples_.size() + count;
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] { return samples_.size() >= wanted; }))
        << samples_.size() << " samples of " << wanted;
  }
  /// Waits for fail() of the driver; returns its text.
  std::string await_failure() {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] { return !queue_.failure().empty(); }));
    return queue_.failure();
  }
  /// Waits for recover() of the driver.
  void await_recovery() {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] { return queue_.failure().empty(); }));
  }
  /// Waits for begin_anew() of the driver; returns its text.
  std::string await_break() {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kLong, [&] { return queue_.latest().breaks > 0; }));
    return queue_.break_reason();
  }
  /// Waits for a sample whose first record satisfies `wanted`; returns that record.
  template <class Wanted>
  Record await_record(Wanted wanted) {
    std::unique_lock lock(mutex_);
    const std::size_t from = samples_.empty() ? 0 : samples_.size() - 1;
    std::size_t looked = from;
    const bool came = changed_.wait_for(lock, kLong, [&] {
      for (; looked < samples_.size(); ++looked) {
        if (wanted(samples_[looked].records.front())) return true;
      }
      return false;
    });
    EXPECT_TRUE(came) << "no sample is as wanted";
    return came ? samples_[looked].records.front() : Record{};
  }
  [[nodiscard]] std::vector<Delivered<Record>> samples() const {
    const std::lock_guard lock(mutex_);
    return samples_;
  }
  [[nodiscard]] const WallClock& clock() const { return clock_; }
  [[nodiscard]] const SampleQueue& queue() const { return queue_; }
  void close() { queue_.close(); }

 private:
  const std::uint32_t capacity_;
  WallClock clock_;
  SampleQueue queue_;
  mutable std::mutex mutex_;  // guards samples_
  std::condition_variable changed_;
  std::vector<Delivered<Record>> samples_;
};

/// Prints statistics of durations in milliseconds; informative only.
inline void print_times(const char* what, std::vector<double> times_ms) {
  if (times_ms.empty()) return;
  std::sort(times_ms.begin(), times_ms.end());
  const auto at = [&](double share) {
    return times_ms[static_cast<std::size_t>(share * static_cast<double>(times_ms.size() - 1))];
  };
  std::printf("%s: median %.3f ms, p99 %.3f ms, largest %.3f ms of %zu\n", what, at(0.5), at(0.99),
              times_ms.back(), times_ms.size());
}

}  // namespace rave::testing
