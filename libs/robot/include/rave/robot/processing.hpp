// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "rave/base/random.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/robot/reading.hpp"

namespace rave {

/// Errors that are added to what a sensor says. Zero switches a term off. Which fields a term
/// touches follows from the kind of the sensor:
///   ranges      length: each ray
///   sightings   length: range; angle: bearing
///   pose        length: x and y; angle: yaw
///   odometry    as pose; velocity: v (w stays as it is)
///   neighbours  length: range; angle: bearing; velocity: vx and vy
///   velocity    velocity: v (w stays as it is)
///   contact, values   drop-out alone
struct NoiseSpec {
  double length_sigma_m = 0;  ///< Standard deviation of a normal error of mean 0.
  double angle_sigma_rad = 0;
  double velocity_sigma_mps = 0;
  double length_quantum_m = 0;  ///< Rounds to the nearest multiple, after the normal error.
  double angle_quantum_rad = 0;
  double velocity_quantum_mps = 0;
  /// That a ray reads "no return", that a sighting or neighbour is missing, or that a sample of
  /// another kind comes empty (count 0).
  double dropout_probability = 0;

  [[nodiscard]] bool any() const noexcept;
};

/// One filter: works on each field of each record by itself.
struct FilterSpec {
  enum class Kind {
    /// The middle one of the last `window` readings (fewer at the start; of an even number the
    /// lower of the middle two). No return counts as largest.
    kMedian,
    /// y += (1 - exp(-dt / T)) (x - y), with dt from the stamps. A reading that is not finite
    /// passes as it is and the filter of that field starts anew.
    kExponential,
  };
  Kind kind = Kind::kMedian;
  int window = 5;              ///< Median: odd, 1 to 99.
  double time_constant_s = 0;  ///< Exponential: T, above 0.
};

/// How far a range sensor measures. Noise puts no reading beyond: what would be farther is no
/// return
/// (+infinity), what would be nearer is the least range.
struct RangeLimits {
  double min_m = 0;
  double max_m = std::numeric_limits<double>::infinity();
};

/// What lies between a raw sample of a sensor and the robot's program, in this order.
struct ProcessingSpec {
  NoiseSpec noise{};
  double latency_s = 0;  ///< From the stamp of a sample to its delivery; at most 3600.
  std::vector<FilterSpec> filters{};

  [[nodiscard]] bool empty() const noexcept;
};

/// One sample for the noise of many. What it points to belongs to the caller.
struct NoiseItem {
  SampleHeader* header = nullptr;
  void* records = nullptr;  ///< `header->count` of them.
  RandomStream random;      ///< The sample's own; its next whole block is where it starts.
};

/// The processing chain of one sensor; the same object serves all robots of a group. Immutable, so
/// any thread may use it; what is remembered of one robot lies in memory of the caller, `state`,
/// which must be aligned to 8 bytes, be reset() once and be used by one thread at a time.
///
/// Random numbers are a function of the sample alone, whichever samples are processed with it. A
/// record takes one normal number for each field that noise can touch, in the order of the fields
/// in the record, and the records one after the other take those of fill_normal() from the start
/// of the stream. For drop-out a record takes one word of fill_bits() from 2^31 blocks further on;
/// where the whole sample drops out, that is the first. So one term never changes the numbers of
/// another.
class Processing {
 public:
  /// `capacity`: records of one sample at most. `period_s`: time between two samples, 0 if they
  /// come irregularly. Error: kInvalidArgument for values out of range, for noise that has nothing
  /// to act on and for filters on kinds whose records come and go.
  [[nodiscard]] static Result<Processing> make(const ProcessingSpec& spec, ReadingKind kind,
                                               std::uint32_t capacity, double period_s,
                                               const RangeLimits& limits = {});

  /// Bytes per robot and sensor, a multiple of 8.
  [[nodiscard]] std::size_t state_size() const noexcept { return state_size_; }
  /// Samples that can be under way at once: latency over period plus one; for irregular ones those
  /// of 200 a second, at least 64.
  [[nodiscard]] std::uint32_t depth() const noexcept { return depth_; }
  /// Forgets everything; equal bits each time.
  void reset(std::byte* state) const noexcept;

  /// Takes a raw sample with `raw.count` records. Stamps must not step back. If the samples under
  /// way fill the ring, the oldest is lost and counts in `dropped` of the next delivery, as do
  /// records beyond the capacity.
  void push(const SampleHeader& raw, const void* records, const RandomStream& random,
            std::byte* state) const noexcept;
  /// As push() for a sample that has been through apply_noise().
  void push_noisy(const SampleHeader& noisy, const void* records, std::byte* state) const noexcept;

  /// Moves every sample with stamp + latency <= now through the filters, in order. The newest ends
  /// in `*out` and `out_records` (room for `capacity` records): true. If none is due, both stay as
  /// they are: false. `out->dropped` adds up what was lost since the last delivery; `stamp_ns`,
  /// `sequence` and `fresh` are those of the raw sample. An empty sample passes the filters by.
  bool deliver(SimTime now, std::byte* state, SampleHeader* out, void* out_records) const noexcept;

  /// As deliver(), but stops after the oldest sample that is due: for events, which all count.
  bool deliver_oldest(SimTime now, std::byte* state, SampleHeader* out,
                      void* out_records) const noexcept;

  /// The noise alone, in place. Drop-out may lower `header.count`; nothing else of a header
  /// changes.
  void apply_noise(SampleHeader& header, void* records, const RandomStream& random) const noexcept;
  /// The same for many samples, the quicker the more there are: numbers are drawn a batch at a
  /// time.
  void apply_noise(std::span<const NoiseItem> items) const noexcept;
  /// Whether noise is all: no latency, no filter. Then apply_noise() gives what push() and
  /// deliver() would, and no state is needed.
  [[nodiscard]] bool noise_only() const noexcept { return latency_.ns == 0 && stages_.empty(); }

 private:
  struct Stage {
    FilterSpec filter;
    std::size_t offset = 0;  ///< Of the filter's memory in the state.
  };
  Processing() = default;
  std::byte* enqueue(const SampleHeader& raw, const void* records, std::byte* state) const noexcept;
  bool deliver_some(SimTime now, bool all, std::byte* state, SampleHeader* out,
                    void* out_records) const noexcept;
  [[nodiscard]] std::byte* slot(std::byte* state, std::uint32_t index) const noexcept;
  void filter(const Stage& stage, const SampleHeader& header, void* records,
              std::byte* state) const noexcept;

  NoiseSpec noise_;
  RangeLimits limits_;
  std::vector<Stage> stages_;
  ReadingKind kind_ = ReadingKind::kNone;
  std::uint32_t capacity_ = 0;
  std::uint32_t depth_ = 0;
  std::uint32_t record_size_ = 0;
  Duration latency_;
  std::size_t slot_size_ = 0;
  std::size_t state_size_ = 0;
  bool noisy_ = false;
};

}  // namespace rave
