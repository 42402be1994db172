// SPDX-License-Identifier: Apache-2.0
// The queue between the thread of a hardware driver and the engine. Stepped: nothing is lost, and
// the producer waits. Live: the newest counts, and the oldest is lost.
#include "rave/robot/sample_queue.hpp"

#include <algorithm>
#include <cstring>

#include "rave/base/check.hpp"

namespace rave {
namespace {

using Lock = std::unique_lock<std::mutex>;

constexpr std::size_t kLongestText = 4096;

std::int64_t steady_ns(std::chrono::steady_clock::time_point t) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(t.time_since_epoch()).count();
}

std::string text_of(std::int64_t ns) { return fmt::format("{:.9f} s", SimTime{ns}.seconds()); }

}  // namespace

// All memory for samples is taken here, so publish() only copies.
SampleQueue::SampleQueue(ReadingKind kind, std::uint32_t max_records, std::size_t depth,
                         const RunClock* live, std::unique_ptr<SampleGate> gate)
    : max_records_(max_records),
      record_size_(record_size(kind)),
      depth_(depth),
      live_(live),
      headers_(depth),
      records_(depth * max_records * record_size_),
      before_(depth),
      gate_(std::move(gate)) {
  RAVE_CHECK(record_size_ > 0 && max_records > 0 && depth > 0);
}

std::byte* SampleQueue::records_of(std::size_t slot) noexcept {
  return records_.data() + slot * max_records_ * record_size_;
}

bool SampleQueue::wait_until(SimTime t) noexcept {
  Lock lock(mutex_);
  // A stepped driver goes ahead as fast as the queue has room; the step takes samples by stamp.
  if (live_ == nullptr) return !closed_;
  producer_waits_ = true;
  while (!closed_ && live_->now() < t) {
    const auto due = live_->wall_time_of(t);
    const auto woken = to_producer_.wait_until(lock, due);
    // The two conversions of the clock may differ by rounding; the wall time decides.
    if (woken == std::cv_status::timeout && live_->wall_time_of(t) <= due) break;
  }
  producer_waits_ = false;
  return !closed_;
}

bool SampleQueue::refused(SimTime stamp, std::uint32_t count) {
  std::string why;
  if (count > max_records_) {
    why = fmt::format("holds {} records, more than the {} that were declared", count, max_records_);
  } else if (stamp.ns < newest_ns_) {
    // Samples are taken by stamp; one from before the last step could not be taken any more.
    why = "came after one of " + text_of(newest_ns_) + "; stamps must not step back";
  } else if (live_ == nullptr && stamp.ns <= complete_ns_) {
    why = "came after the driver had declared samples complete up to " + text_of(complete_ns_);
  } else {
    return false;
  }
  ++dropped_;
  dropped_since_next_ += count;
  // The first complaint is kept: it is closest to the cause.
  if (complaint_.empty()) {
    complaint_ = fmt::format("the sample of {} was dropped: it {}", text_of(stamp.ns), why);
  }
  return true;
}

// The wall clock continues while the run is paused, so the moment is kept by that one. A stamp that
// lies ahead makes no sample younger than its arrival.
void SampleQueue::note_moment(SimTime stamp) {
  const std::int64_t lag_ns = std::max<std::int64_t>((live_->now() - stamp).ns, 0);
  moment_ns_ = steady_ns(std::chrono::steady_clock::now()) - lag_ns;
  lag_ns_ = lag_ns;
}

bool SampleQueue::passes(SimTime stamp, const void* records, std::uint32_t count) {
  if (!gate_ || count == 0) return true;
  const SampleGate::Verdict verdict = gate_->judge(stamp, records);
  if (verdict == SampleGate::Verdict::kRefuse) {
    ++gated_;
    refusal_ = gate_->reason();
    return false;
  }
  if (verdict == SampleGate::Verdict::kAnew) {
    break_reason_ = gate_->reason();
    ++breaks_;
  }
  return true;
}

void SampleQueue::lose_oldest() {
  ++dropped_;
  dropped_since_next_ += headers_[first_].count;
  first_ = (first_ + 1) % depth_;
  --count_;
}

bool SampleQueue::publish(SimTime stamp, const void* records, std::uint32_t count) noexcept {
  Lock lock(mutex_);
  if (closed_) return false;
  if (refused(stamp, count) || !passes(stamp, records, count)) return true;
  if (live_ != nullptr) {
    // Live: the newest is worth most, and a driver must not be blocked by a slow run.
    if (count_ == depth_) lose_oldest();
  } else if (count_ == depth_) {
    producer_waits_ = true;
    to_producer_.wait(lock, [&] { return closed_ || count_ < depth_; });
    producer_waits_ = false;
    if (closed_) return false;
  }
  const std::size_t slot = (first_ + count_) % depth_;
  ++count_;
  newest_ns_ = stamp.ns;
  if (live_ != nullptr) note_moment(stamp);
  before_[slot] = {breaks_, gated_};
  headers_[slot] = {stamp.ns, ++sequence_, count, 0, 0};
  if (count > 0) std::memcpy(records_of(slot), records, std::size_t{count} * record_size_);
  if (consumer_waits_) to_consumer_.notify_one();
  return true;
}

// A stepped driver promises that nothing older than t will follow. Without the promise the engine
// could not tell "no sample" from "not yet".
void SampleQueue::complete_up_to(SimTime t) noexcept {
  Lock lock(mutex_);
  complete_ns_ = std::max(complete_ns_, t.ns);
  if (consumer_waits_) to_consumer_.notify_one();
}

void SampleQueue::fail(const char* text, std::uint64_t size) noexcept {
  Lock lock(mutex_);
  if (failed_) return;
  failed_ = true;
  failure_.assign(text, std::min<std::size_t>(size, kLongestText));
  if (failure_.empty()) failure_ = "the driver gave no reason";
  to_consumer_.notify_one();
}

void SampleQueue::recover() noexcept {
  const Lock lock(mutex_);
  // A stepped driver runs ahead of the run, so its failure is final: the time of its recovery would
  // be indeterminate.
  if (live_ == nullptr) return;
  failed_ = false;
  failure_.clear();
}

void SampleQueue::begin_anew(const char* text, std::uint64_t size) noexcept {
  const Lock lock(mutex_);
  if (live_ == nullptr) return;
  break_reason_.assign(text, std::min<std::size_t>(size, kLongestText));
  ++breaks_;
}

SimTime SampleQueue::now() const noexcept {
  return live_ == nullptr ? SimTime{INT64_MIN} : live_->now();
}

SampleQueue::Wait SampleQueue::wait_complete(SimTime t, std::chrono::milliseconds limit) {
  Lock lock(mutex_);
  if (live_ != nullptr) return failed_ || closed_ ? Wait::kFailed : Wait::kComplete;
  const auto state = [&] {
    // Stamps do not decrease, so a stamp after t proves completeness up to t.
    if (complete_ns_ >= t.ns || newest_ns_ > t.ns) return Wait::kComplete;
    if (failed_ || closed_) return Wait::kFailed;
    // A full queue is no timeout: the driver cannot continue before samples are taken.
    return count_ == depth_ ? Wait::kFull : Wait::kTimeout;
  };
  if (const Wait now = state(); now != Wait::kTimeout) return now;
  consumer_waits_ = true;
  // the consumer must wait, so announce the room that next() did not
  if (producer_waits_) to_producer_.notify_one();
  to_consumer_.wait_for(lock, limit, [&] { return state() != Wait::kTimeout; });
  consumer_waits_ = false;
  return state();
}

bool SampleQueue::next(SimTime up_to, SampleHeader* header, void* records) {
  Lock lock(mutex_);
  if (count_ == 0 || headers_[first_].stamp_ns > up_to.ns) return false;
  *header = headers_[first_];
  header->dropped = dropped_since_next_;
  dropped_since_next_ = 0;
  taken_ = before_[first_];
  if (header->count > 0) {
    std::memcpy(records, records_of(first_), std::size_t{header->count} * record_size_);
  }
  first_ = (first_ + 1) % depth_;
  --count_;
  // Waking the producer for each sample would cause a thread switch per sample. It sleeps until
  // half of the queue is free, or until the consumer must wait for it.
  if (live_ == nullptr && producer_waits_ && count_ <= depth_ / 2) to_producer_.notify_one();
  return true;
}

const std::byte* SampleQueue::records_of(std::size_t slot) const noexcept {
  return records_.data() + slot * max_records_ * record_size_;
}

/// next() leaves a sample in its slot until the slot is reused, depth_ samples later.
std::size_t SampleQueue::newest_slot() const noexcept {
  return (first_ + count_ + depth_ - 1) % depth_;
}

bool SampleQueue::newest(SampleHeader* header, void* record, Before* before) const {
  const Lock lock(mutex_);
  if (newest_ns_ == INT64_MIN) return false;
  *header = headers_[newest_slot()];
  if (before != nullptr) *before = before_[newest_slot()];
  if (header->count > 0) std::memcpy(record, records_of(newest_slot()), record_size_);
  return true;
}

bool SampleQueue::newer_than(std::uint32_t sequence, SampleHeader* header, void* records) const {
  const Lock lock(mutex_);
  if (newest_ns_ == INT64_MIN || headers_[newest_slot()].sequence == sequence) return false;
  *header = headers_[newest_slot()];
  if (header->count > 0) {
    std::memcpy(records, records_of(newest_slot()), std::size_t{header->count} * record_size_);
  }
  return true;
}

void SampleQueue::close() {
  const Lock lock(mutex_);
  closed_ = true;
  to_producer_.notify_all();
  to_consumer_.notify_all();
}

void SampleQueue::reopen() {
  const Lock lock(mutex_);
  first_ = 0;
  count_ = 0;
  closed_ = false;
  failed_ = false;
  newest_ns_ = INT64_MIN;
  moment_ns_ = kNever;
  lag_ns_ = 0;
  complete_ns_ = INT64_MIN;
  sequence_ = 0;
  dropped_since_next_ = 0;
  dropped_ = 0;
  failure_.clear();
  complaint_.clear();
  taken_ = {};
  breaks_ = 0;
  gated_ = 0;
  refusal_.clear();
  break_reason_.clear();
  if (gate_) gate_->reset();
}

void SampleQueue::clock_changed() {
  const Lock lock(mutex_);
  to_producer_.notify_all();
}

std::string SampleQueue::failure() const {
  const Lock lock(mutex_);
  return failure_;
}

bool SampleQueue::failed() const {
  const Lock lock(mutex_);
  return failed_;
}

std::optional<std::chrono::steady_clock::time_point> SampleQueue::newest_moment() const noexcept {
  const std::int64_t ns = moment_ns_;
  if (ns == kNever) return std::nullopt;
  return std::chrono::steady_clock::time_point(std::chrono::nanoseconds(ns));
}

std::string SampleQueue::complaint() const {
  const Lock lock(mutex_);
  return complaint_;
}

std::string SampleQueue::refusal() const {
  const Lock lock(mutex_);
  return refusal_;
}

std::string SampleQueue::break_reason() const {
  const Lock lock(mutex_);
  return break_reason_;
}

std::uint64_t SampleQueue::dropped() const {
  const Lock lock(mutex_);
  return dropped_;
}

}  // namespace rave
