// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstring>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "rave/robot/hardware_sensor.hpp"

namespace rave::recording {

inline constexpr std::int64_t kForever_ns = std::numeric_limits<std::int64_t>::max();

/// One call of publish().
template <class Record>
struct Published {
  std::int64_t stamp_ns = 0;
  std::vector<Record> records;
};

/// Bits, so that -0 and 0 differ.
template <class Record>
bool operator==(const Published<Record>& a, const Published<Record>& b) {
  return a.stamp_ns == b.stamp_ns && a.records.size() == b.records.size() &&
         std::memcmp(a.records.data(), b.records.data(), a.records.size() * sizeof(Record)) == 0;
}

/// A host's side of a sensor: keeps what it is given, has room for `room` samples, and a clock
/// that only the test moves. Waiting is on conditions, never on time.
template <class Record>
class RecordingSink final : public SampleSink {
 public:
  explicit RecordingSink(std::size_t room = std::numeric_limits<std::size_t>::max())
      : room_(room) {}

  bool wait_until(SimTime t) noexcept override {
    std::unique_lock lock(mutex_);
    waits_for_ns_ = t.ns;
    changed_.notify_all();
    changed_.wait(lock, [&] { return closed_ || now_ns_ >= t.ns; });
    waits_for_ns_ = -1;
    return !closed_;
  }

  bool publish(SimTime stamp, const void* records, std::uint32_t count) noexcept override {
    std::unique_lock lock(mutex_);
    blocked_ = published_.size() >= room_;
    changed_.notify_all();
    changed_.wait(lock, [&] { return closed_ || published_.size() < room_; });
    blocked_ = false;
    if (closed_) return false;
    if (stamp.ns <= complete_ns_) fault_ = "published in time that was said to be complete";
    if (!published_.empty() && stamp.ns <= published_.back().stamp_ns) {
      fault_ = "a stamp came twice or stepped back";
    }
    const auto* first = static_cast<const Record*>(records);
    published_.push_back({stamp.ns, {first, first + count}});
    return true;
  }

  void complete_up_to(SimTime t) noexcept override {
    const std::lock_guard lock(mutex_);
    if (t.ns < complete_ns_) fault_ = "completeness was taken back";
    complete_ns_ = t.ns;
    changed_.notify_all();
  }

  void recover() noexcept override {}
  void begin_anew(const char*, std::uint64_t) noexcept override {}
  void fail(const char* text, std::uint64_t size) noexcept override {
    const std::lock_guard lock(mutex_);
    fault_.assign(text, size);
  }

  [[nodiscard]] SimTime now() const noexcept override {
    const std::lock_guard lock(mutex_);
    return {now_ns_};
  }

  /// Waits for the end of the recording.
  void await_end() { await_complete(kForever_ns); }
  void await_complete(std::int64_t t_ns) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return complete_ns_ >= t_ns; });
  }
  /// Waits until the player has nothing to do before the clock moves on (or the end).
  void await_idle() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return waits_for_ns_ > now_ns_ || complete_ns_ == kForever_ns; });
  }
  /// Waits until the player cannot go on for want of room.
  void await_blocked() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return blocked_; });
  }

  void set_now(std::int64_t now_ns) {
    const std::lock_guard lock(mutex_);
    now_ns_ = now_ns;
    changed_.notify_all();
  }
  /// From now on the calls of the player return false.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

  [[nodiscard]] std::vector<Published<Record>> published() const {
    const std::lock_guard lock(mutex_);
    return published_;
  }
  [[nodiscard]] std::int64_t complete_ns() const {
    const std::lock_guard lock(mutex_);
    return complete_ns_;
  }
  /// What broke the contract of SampleSink; empty if nothing did.
  [[nodiscard]] std::string fault() const {
    const std::lock_guard lock(mutex_);
    return fault_;
  }

 private:
  const std::size_t room_;
  mutable std::mutex mutex_;  // guards everything below
  std::condition_variable changed_;
  std::vector<Published<Record>> published_;
  std::int64_t complete_ns_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t now_ns_ = -1;
  std::int64_t waits_for_ns_ = -1;
  bool blocked_ = false;
  bool closed_ = false;
  std::string fault_;
};

}  // namespace rave::recording
