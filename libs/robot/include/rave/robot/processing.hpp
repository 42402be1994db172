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

/// Errors that are added to the readings of a sensor. Zero disables a term. The kind of the sensor
/// determines which fields a term changes (`noise` of its fields in reading_type.hpp); a kind
/// without such a field has drop-out only.
struct NoiseSpec {
  double length_sigma_m = 0;  ///< Standard deviation of Gaussian noise with mean 0.
  double angle_sigma_rad = 0;
  double velocity_sigma_mps = 0;
  /// Quantisation: rounds to the nearest multiple, after the Gaussian noise.
  double length_quantum_m = 0;
  double angle_quantum_rad = 0;
  double velocity_quantum_mps = 0;
  /// Probability that a ray reads "no return", that a sighting or neighbour is missing, or that a
  /// sample of another kind is empty (count 0).
  double dropout_probability = 0;

  [[nodiscard]] bool any() const noexcept;
};

/// One filter. It processes each field of each record separately.
struct FilterSpec {
  enum class Kind {
    /// The median of the last `window` readings (fewer at the start; of an even number the lower of
    /// the middle two). No return counts as the largest value.
    kMedian,
    /// y += (1 - exp(-dt / T)) (x - y), with dt from the stamps. A non-finite reading is passed on
    /// unchanged and resets the filter of its field.
    kExponential,
  };
  Kind kind = Kind::kMedian;
  int window = 5;              ///< Median: odd, 1 to 99.
  double time_constant_s = 0;  ///< Exponential: T, above 0.
};

/// The measuring range of a range sensor, applied after noise: readings beyond max_m become no
/// return (+infinity), readings below min_m become min_m.
struct RangeLimits {
  double min_m = 0;
  double max_m = std::numeric_limits<double>::infinity();
};

/// The processing between a raw sample of a sensor and the program, in this order.
struct ProcessingSpec {
  NoiseSpec noise{};
  double latency_s = 0;  ///< Time from the stamp of a sample to its delivery; at most 3600.
  std::vector<FilterSpec> filters{};

  [[nodiscard]] bool empty() const noexcept;
};

/// One sample for apply_noise() with several. The caller owns the memory.
struct NoiseItem {
  SampleHeader* header = nullptr;
  void* records = nullptr;  ///< `header->count` of them.
  RandomStream random;      ///< The stream of the sample, starting at its next whole block.
};

/// The processing chain of one sensor; one object serves all robots of a group. Immutable, so any
/// thread may use it. What is remembered of a robot is in memory of the caller, `state`: aligned to
/// 8 bytes, reset() once, used by one thread at a time.
///
/// Random numbers depend on the sample alone, not on which samples are processed together. A record
/// takes one normal number for each field that noise can change, in the order of the fields; the
/// records take those of fill_normal() one after the other from the start of the stream. For
/// drop-out a record takes one word of fill_bits() from 2^31 blocks further on; if the whole sample
/// can drop out, it takes the first. So no term changes the random numbers of another.
class Processing {
 public:
  /// `capacity`: the largest number of records per sample. `period_s`: time between two samples, 0
  /// if irregular. Error kInvalidArgument: values out of range, noise without a field to act on,
  /// filters for kinds whose number of records varies.
  [[nodiscard]] static Result<Processing> make(const ProcessingSpec& spec, ReadingKind kind,
                                               std::uint32_t capacity, double period_s,
                                               const RangeLimits& limits = {});

  /// Bytes of state per robot and sensor, a multiple of 8.
  [[nodiscard]] std::size_t state_size() const noexcept { return state_size_; }
  /// The number of samples that can be in transit at once: latency over period plus one; for
  /// irregular samples those of 200 per second, at least 64.
  [[nodiscard]] std::uint32_t depth() const noexcept { return depth_; }
  /// Initialises the state; it is then always bit-identical.
  void reset(std::byte* state) const noexcept;

  /// Takes a raw sample with `raw.count` records. Stamps must not decrease. If the ring of samples
  /// in transit is full, the oldest is lost and counted in `dropped` of the next delivery, as are
  /// records beyond the capacity.
  void push(const SampleHeader& raw, const void* records, const RandomStream& random,
            std::byte* state) const noexcept;
  /// Like push(), for a sample that has been through apply_noise().
  void push_noisy(const SampleHeader& noisy, const void* records, std::byte* state) const noexcept;

  /// Passes every sample with stamp + latency <= now through the filters, in order. Writes the
  /// newest to `*out` and `out_records` (room for `capacity` records) and returns true. If none is
  /// due, both stay unchanged and it returns false. `out->dropped` is the number of records lost
  /// since the last delivery; `stamp_ns`, `sequence` and `fresh` are those of the raw sample. An
  /// empty sample bypasses the filters.
  bool deliver(SimTime now, std::byte* state, SampleHeader* out, void* out_records) const noexcept;

  /// Like deliver(), but stops after the oldest sample that is due; for events, none of which may
  /// be skipped.
  bool deliver_oldest(SimTime now, std::byte* state, SampleHeader* out,
                      void* out_records) const noexcept;

  /// Adds the noise in place. Drop-out may lower `header.count`; other fields of the header do not
  /// change.
  void apply_noise(SampleHeader& header, void* records, const RandomStream& random) const noexcept;
  /// Like the above, for many samples. Larger batches cost less per sample, because random numbers
  /// are drawn in batches.
  void apply_noise(std::span<const NoiseItem> items) const noexcept;
  /// Whether the processing is noise alone, without latency and filters. apply_noise() is then
  /// equivalent to push() and deliver(), and no state is needed.
  [[nodiscard]] bool noise_only() const noexcept { return latency_.ns == 0 && stages_.empty(); }

 private:
  struct Stage {
    FilterSpec filter;
    std::size_t offset = 0;  ///< Offset of the filter's memory in the state.
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
