// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

/// How simulation time runs in a live run. Called from any thread; must not call back a queue.
class RunClock {
 public:
  [[nodiscard]] virtual SimTime now() const noexcept = 0;
  /// When `t` is due: the same answer until clock_changed(); time_point::max() while the run is
  /// paused.
  [[nodiscard]] virtual std::chrono::steady_clock::time_point wall_time_of(
      SimTime t) const noexcept = 0;

 protected:
  ~RunClock() = default;
};

/// The host's side of a SampleSink: a bounded queue from the thread of one driver (the producer)
/// to the engine (the consumer, one thread at a time). All memory is taken when it is made.
///
/// Stepped: nothing is lost; publish() waits for room. Live: a full queue loses its oldest sample.
/// What breaks the contract of SampleSink (a stamp that steps back or lies in time that was said to
/// be complete, more records than fit) is dropped and counted, and complaint() describes the first.
class SampleQueue final : public SampleSink {
 public:
  /// `max_records`: of one sample. `depth`: samples, at least 1. `live`: null in a stepped run;
  /// otherwise must outlive the queue.
  SampleQueue(ReadingKind kind, std::uint32_t max_records, std::size_t depth, const RunClock* live);
  SampleQueue(const SampleQueue&) = delete;
  SampleQueue& operator=(const SampleQueue&) = delete;
  ~SampleQueue() = default;

  // Producer side.
  bool wait_until(SimTime t) noexcept override;
  bool publish(SimTime stamp, const void* records, std::uint32_t count) noexcept override;
  void complete_up_to(SimTime t) noexcept override;
  void fail(const char* text, std::uint64_t size) noexcept override;
  void recover() noexcept override;
  [[nodiscard]] SimTime now() const noexcept override;

  // Consumer side.
  enum class Wait {
    kComplete,  ///< All samples with a stamp up to `t` are in the queue.
    kFull,      ///< There may be more, but no room: take samples out, then call again.
    kFailed,    ///< The driver failed, or the queue is closed, before `t` was complete.
    kTimeout,
  };
  /// Stepped: waits until the producer has promised completeness up to `t` or shown it by a later
  /// stamp. Live: never waits; kComplete unless the driver failed.
  [[nodiscard]] Wait wait_complete(SimTime t, std::chrono::milliseconds limit);

  /// Takes out the oldest sample if its stamp is at most `up_to`; false: there is none. `records`
  /// has room for `max_records`. `header->sequence` counts published samples from 1, `dropped` the
  /// records lost since the last call that gave one; `fresh` is 0.
  [[nodiscard]] bool next(SimTime up_to, SampleHeader* header, void* records);

  /// The newest sample that was taken in, whether next() has given it out or not; false: there is
  /// none. `record` has room for one record and gets the first one of the sample. Any thread.
  [[nodiscard]] bool newest(SampleHeader* header, void* record) const;

  /// Unblocks the producer; its calls return false from now on. Samples can still be taken out.
  /// Any thread.
  void close();
  /// As new. The producer's thread must have ended.
  void reopen();
  /// To be called when the run clock was paused, continued or changed its pace. Any thread.
  void clock_changed();

  /// What the driver said in fail(); empty if it did not or has recovered. Any thread.
  [[nodiscard]] std::string failure() const;
  /// The first breach of the contract; empty if there was none. Any thread.
  [[nodiscard]] std::string complaint() const;
  /// Whether failure() says something. Any thread.
  [[nodiscard]] bool failed() const;
  /// When the newest sample was taken in, by the wall clock; nothing if none was since the queue
  /// was opened. Live. Any thread, no lock.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> newest_arrival()
      const noexcept;
  /// All samples lost since the queue was opened. Any thread.
  [[nodiscard]] std::uint64_t dropped() const;

 private:
  [[nodiscard]] std::byte* records_of(std::size_t slot) noexcept;
  [[nodiscard]] bool refused(SimTime stamp, std::uint32_t count);
  void lose_oldest();

  const std::uint32_t max_records_;
  const std::uint32_t record_size_;
  const std::size_t depth_;
  const RunClock* const live_;
  static constexpr std::int64_t kNever = INT64_MIN;
  std::atomic<std::int64_t> arrival_ns_{kNever};  // of the newest sample, steady clock

  mutable std::mutex mutex_;             // guards everything below
  std::condition_variable to_producer_;  // room, clock or close
  std::condition_variable to_consumer_;  // sample, completeness, failure or close
  std::vector<SampleHeader> headers_;    // a ring of depth_ slots
  std::vector<std::byte> records_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  bool producer_waits_ = false;
  bool consumer_waits_ = false;
  bool closed_ = false;
  bool failed_ = false;
  std::int64_t newest_ns_ = INT64_MIN;    // stamp of the last sample that was taken in
  std::int64_t complete_ns_ = INT64_MIN;  // promised by the producer
  std::uint32_t sequence_ = 0;
  std::uint32_t dropped_since_next_ = 0;
  std::uint64_t dropped_ = 0;
  std::string failure_;
  std::string complaint_;
};

}  // namespace rave
