// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/robot/hardware_sensor.hpp"
#include "rave/robot/reading.hpp"
#include "rave/robot/sample_gate.hpp"

namespace rave {

/// Converts simulation time to wall time in a live run. Called from any thread; must not call a
/// queue.
class RunClock {
 public:
  [[nodiscard]] virtual SimTime now() const noexcept = 0;
  /// The wall time at which `t` is due. It is constant until clock_changed(); time_point::max()
  /// while the run is paused.
  [[nodiscard]] virtual std::chrono::steady_clock::time_point wall_time_of(
      SimTime t) const noexcept = 0;

 protected:
  ~RunClock() = default;
};

/// The host's implementation of SampleSink: a bounded queue from the thread of one driver (the
/// producer) to the engine (the consumer, one thread at a time). All memory is allocated by the
/// constructor.
///
/// Stepped: no sample is lost; publish() waits for room. Live: a full queue loses its oldest
/// sample. Samples that violate the contract of SampleSink (a stamp that decreases or lies in
/// completed time, too many records) are dropped and counted; complaint() describes the first.
/// Those that its gate refuses are dropped, too, and counted in Before.
class SampleQueue final : public SampleSink {
 public:
  /// `max_records`: limit per sample. `depth`: limit of samples, at least 1. `live`: null in a
  /// stepped run; otherwise must outlive the queue.
  /// `gate`: may be null.
  SampleQueue(ReadingKind kind, std::uint32_t max_records, std::size_t depth, const RunClock* live,
              std::unique_ptr<SampleGate> gate = nullptr);
  SampleQueue(const SampleQueue&) = delete;
  SampleQueue& operator=(const SampleQueue&) = delete;
  ~SampleQueue() = default;

  // Producer side.
  bool wait_until(SimTime t) noexcept override;
  bool publish(SimTime stamp, const void* records, std::uint32_t count) noexcept override;
  void complete_up_to(SimTime t) noexcept override;
  void fail(const char* text, std::uint64_t size) noexcept override;
  void recover() noexcept override;
  void begin_anew(const char* text, std::uint64_t size) noexcept override;
  [[nodiscard]] SimTime now() const noexcept override;

  // Consumer side.
  enum class Wait {
    kComplete,  ///< All samples with a stamp up to `t` are in the queue.
    kFull,      ///< The queue is full and more samples may follow: take some out, then call again.
    kFailed,    ///< The driver failed or the queue was closed before `t` was complete.
    kTimeout,
  };
  /// Stepped: waits until the producer has promised completeness up to `t`, or has published a
  /// later stamp. Live: returns at once, with kComplete unless the driver failed.
  [[nodiscard]] Wait wait_complete(SimTime t, std::chrono::milliseconds limit);

  /// Takes the oldest sample out if its stamp is at most `up_to`; false: there is none. `records`
  /// must have room for `max_records`. `header->sequence` numbers published samples from 1;
  /// `dropped` is the number of records lost since the last successful call; `fresh` is 0, and the
  /// engine sets it when it delivers the sample.
  [[nodiscard]] bool next(SimTime up_to, SampleHeader* header, void* records);

  /// What had become of the samples before one.
  struct Before {
    std::uint32_t breaks = 0;   ///< How often they did not continue those before.
    std::uint64_t refused = 0;  ///< How many the gate refused.
    friend bool operator==(const Before&, const Before&) = default;
  };
  /// Of the sample that next() returned last. The consumer's.
  [[nodiscard]] const Before& before() const noexcept { return taken_; }
  /// The same up to now, which in a stepped run is further. Any thread, without a lock.
  [[nodiscard]] Before latest() const noexcept { return {breaks_, gated_}; }
  /// Why the last sample was refused, and why the last break was one; empty if there was none. Any
  /// thread.
  [[nodiscard]] std::string refusal() const;
  [[nodiscard]] std::string break_reason() const;

  /// The newest published sample, also after next() has returned it; false: there is none. `record`
  /// must have room for one record and receives the first of the sample. `before` may be null. Any
  /// thread.
  [[nodiscard]] bool newest(SampleHeader* header, void* record, Before* before = nullptr) const;

  /// The newest published sample with all its records, unless it is number `sequence` or there is
  /// none: false. `records` must have room for max_records(). Any thread.
  [[nodiscard]] bool newer_than(std::uint32_t sequence, SampleHeader* header, void* records) const;
  [[nodiscard]] std::uint32_t max_records() const noexcept { return max_records_; }

  /// Unblocks the producer, whose calls return false from now on. Samples can still be taken out.
  /// Any thread.
  void close();
  /// Resets the queue to its initial state. The producer's thread must have ended.
  void reopen();
  /// Call it after the run clock was paused, resumed or changed its pace. Any thread.
  void clock_changed();

  /// The text of the driver's fail(); empty if it has not failed or has recovered. Any thread.
  [[nodiscard]] std::string failure() const;
  /// The first violation of the contract; empty if there was none. Any thread.
  [[nodiscard]] std::string complaint() const;
  /// Whether the driver has failed and not recovered. Any thread.
  [[nodiscard]] bool failed() const;
  /// Wall time at which the newest sample was true, which is before it arrived if its stamp says
  /// so; empty if there was none since the queue was opened. Live runs. Any thread, without a lock.
  [[nodiscard]] std::optional<std::chrono::steady_clock::time_point> newest_moment() const noexcept;
  /// How old the newest sample was when it arrived, by its stamp; at least 0. Live runs. Any
  /// thread, without a lock.
  [[nodiscard]] Duration newest_lag() const noexcept { return {lag_ns_}; }
  /// The number of samples lost since the queue was opened. Any thread.
  [[nodiscard]] std::uint64_t dropped() const;

 private:
  [[nodiscard]] std::byte* records_of(std::size_t slot) noexcept;
  [[nodiscard]] const std::byte* records_of(std::size_t slot) const noexcept;
  [[nodiscard]] std::size_t newest_slot() const noexcept;
  [[nodiscard]] bool refused(SimTime stamp, std::uint32_t count);
  [[nodiscard]] bool passes(SimTime stamp, const void* records, std::uint32_t count);
  void note_moment(SimTime stamp);
  void lose_oldest();

  const std::uint32_t max_records_;
  const std::uint32_t record_size_;
  const std::size_t depth_;
  const RunClock* const live_;
  static constexpr std::int64_t kNever = INT64_MIN;
  std::atomic<std::int64_t> moment_ns_{kNever};  // of the newest sample, steady clock
  std::atomic<std::int64_t> lag_ns_{0};          // how much later it arrived

  std::atomic<std::uint32_t> breaks_{0};
  std::atomic<std::uint64_t> gated_{0};  // refused by the gate
  Before taken_;                         // the consumer's

  mutable std::mutex mutex_;             // guards all members below
  std::condition_variable to_producer_;  // room, clock or close
  std::condition_variable to_consumer_;  // sample, completeness, failure or close
  std::vector<SampleHeader> headers_;    // a ring of depth_ slots
  std::vector<std::byte> records_;
  std::vector<Before> before_;  // by slot
  std::unique_ptr<SampleGate> gate_;
  std::string refusal_;
  std::string break_reason_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  bool producer_waits_ = false;
  bool consumer_waits_ = false;
  bool closed_ = false;
  bool failed_ = false;
  std::int64_t newest_ns_ = INT64_MIN;    // stamp of the newest published sample
  std::int64_t complete_ns_ = INT64_MIN;  // promised by the producer
  std::uint32_t sequence_ = 0;
  std::uint32_t dropped_since_next_ = 0;
  std::uint64_t dropped_ = 0;
  std::string failure_;
  std::string complaint_;
};

}  // namespace rave
