// SPDX-License-Identifier: Apache-2.0
// Noise, latency and filters behind a sensor, in this order. The state of all stages is one block
// of bytes per robot, so that no sample allocates.
#include "rave/robot/processing.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "field_filter.hpp"
#include "range_filter.hpp"
#include "rave/robot/reading_type.hpp"

namespace rave {
namespace {

constexpr std::uint64_t kIrregularDepth = 64;
/// Samples in shorter intervals would push each other out of the ring before they are due.
constexpr Duration kIrregularPeriod{5'000'000};
constexpr double kLongestLatency_s = 3600;
constexpr std::size_t kLargestState = std::size_t{64} << 20;

/// At the start of the state, followed by the ring of slots and the filters' states.
struct Ring {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t dropped = 0;
  std::uint32_t reserved = 0;
};

std::size_t whole_words(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

Status check_amount(const char* name, double value, bool applies, ReadingKind kind) {
  if (!std::isfinite(value) || value < 0) {
    return fail(ErrorCode::kInvalidArgument,
                "noise: `{}` is {}; it must be a finite number of at least 0", name, value);
  }
  // Noise without effect is a mistake in the file: its author believes that it is there.
  if (value > 0 && !applies) {
    return fail(ErrorCode::kInvalidArgument, "noise: `{}` has no effect on a sensor of kind `{}`",
                name, to_string(kind));
  }
  return {};
}

Status check_noise(const NoiseSpec& noise, ReadingKind kind) {
  const auto acts = [kind](NoiseTerm term) {
    return std::ranges::any_of(reading_type(kind).fields,
                               [term](const ReadingField& field) { return field.noise == term; });
  };
  const bool length = acts(NoiseTerm::kCoordinate) || acts(NoiseTerm::kDistance);
  const bool angle = acts(NoiseTerm::kAngle);
  const bool velocity = acts(NoiseTerm::kVelocity);
  RAVE_TRY(check_amount("length_sigma_m", noise.length_sigma_m, length, kind));
  RAVE_TRY(check_amount("length_quantum_m", noise.length_quantum_m, length, kind));
  RAVE_TRY(check_amount("angle_sigma_rad", noise.angle_sigma_rad, angle, kind));
  RAVE_TRY(check_amount("angle_quantum_rad", noise.angle_quantum_rad, angle, kind));
  RAVE_TRY(check_amount("velocity_sigma_mps", noise.velocity_sigma_mps, velocity, kind));
  RAVE_TRY(check_amount("velocity_quantum_mps", noise.velocity_quantum_mps, velocity, kind));
  if (!(noise.dropout_probability >= 0 && noise.dropout_probability <= 1)) {
    return fail(ErrorCode::kInvalidArgument,
                "noise: `dropout_probability` is {}; it must lie between 0 and 1",
                noise.dropout_probability);
  }
  return {};
}

/// As words: `ranges, pose and values`.
std::string filtered_kinds() {
  std::vector<std::string_view> names;
  for (std::uint32_t kind = 1; record_size(ReadingKind{kind}) > 0; ++kind) {
    if (detail::filter_fields(ReadingKind{kind}).count > 0) {
      names.push_back(to_string(ReadingKind{kind}));
    }
  }
  const std::string_view last = names.back();
  names.pop_back();
  return fmt::format("{} and {}", fmt::join(names, ", "), last);
}

Status check_filter(const FilterSpec& filter, ReadingKind kind) {
  // A filter needs the same number in each sample; sightings come and go.
  if (detail::filter_fields(kind).count == 0) {
    return fail(ErrorCode::kInvalidArgument,
                "filter: a sensor of kind `{}` cannot be filtered, because its number of records "
                "varies; filters work on {}",
                to_string(kind), filtered_kinds());
  }
  if (filter.kind == FilterSpec::Kind::kMedian) {
    if (filter.window < 1 || filter.window > 99 || filter.window % 2 == 0) {
      return fail(ErrorCode::kInvalidArgument,
                  "median filter: `window` is {}; it must be an odd number from 1 to 99",
                  filter.window);
    }
    return {};
  }
  if (!std::isfinite(filter.time_constant_s) || filter.time_constant_s <= 0) {
    return fail(ErrorCode::kInvalidArgument,
                "exponential filter: `time_constant_s` is {}; it must be a finite number above 0",
                filter.time_constant_s);
  }
  return {};
}

Status check_times(double latency_s, double period_s) {
  if (!(latency_s >= 0 && latency_s <= kLongestLatency_s)) {
    return fail(ErrorCode::kInvalidArgument,
                "`latency_s` is {}; it must lie between 0 and {} seconds", latency_s,
                kLongestLatency_s);
  }
  if (!(period_s == 0 || (period_s >= 1e-9 && period_s <= 1e9))) {
    return fail(ErrorCode::kInvalidArgument,
                "the period is {} s; it must be 0 for an irregular source or lie between 1e-9 and "
                "1e9 seconds",
                period_s);
  }
  return {};
}

std::size_t filter_memory(const FilterSpec& filter, ReadingKind kind, std::uint32_t capacity) {
  if (kind == ReadingKind::kRanges) return detail::range_filter_memory(filter, capacity);
  return std::size_t{capacity} * detail::filter_fields(kind).count * detail::filter_memory(filter);
}

// Samples that can be delayed at the same time by the latency, and the one that is just due.
std::uint64_t ring_depth(Duration latency, Duration period) {
  if (period.ns == 0) return std::max(kIrregularDepth, ring_depth(latency, kIrregularPeriod));
  return static_cast<std::uint64_t>((latency.ns + period.ns - 1) / period.ns + 1);
}

}  // namespace

bool ProcessingSpec::empty() const noexcept {
  return !noise.any() && latency_s == 0 && filters.empty();
}

Result<Processing> Processing::make(const ProcessingSpec& spec, ReadingKind kind,
                                    std::uint32_t capacity, double period_s,
                                    const RangeLimits& limits) {
  if (rave::record_size(kind) == 0 || capacity == 0) {
    return fail(ErrorCode::kInvalidArgument,
                "a sensor of kind `{}` with {} records has nothing to process", to_string(kind),
                capacity);
  }
  RAVE_TRY(check_noise(spec.noise, kind));
  RAVE_TRY(check_times(spec.latency_s, period_s));
  for (const FilterSpec& filter : spec.filters) RAVE_TRY(check_filter(filter, kind));

  Processing made;
  made.noise_ = spec.noise;
  made.limits_ = limits;
  made.noisy_ = spec.noise.any();
  made.kind_ = kind;
  made.capacity_ = capacity;
  made.record_size_ = rave::record_size(kind);
  made.latency_ = from_seconds(spec.latency_s);
  const std::size_t records_size = std::size_t{made.record_size_} * capacity;
  made.slot_size_ = sizeof(SampleHeader) + whole_words(records_size);
  const std::uint64_t depth = ring_depth(made.latency_, from_seconds(period_s));
  // All factors are far below 2^48, and the sum is checked before the next one could overflow it.
  // A wrong unit in the file, such as milliseconds taken for seconds, would otherwise use up the
  // memory.
  bool fits = depth <= kLargestState / made.slot_size_;
  std::size_t size = sizeof(Ring) + (fits ? depth * made.slot_size_ : 0);
  for (const FilterSpec& filter : spec.filters) {
    made.stages_.push_back({filter, size});
    size += filter_memory(filter, kind, capacity);
    fits = fits && size <= kLargestState;
    if (!fits) break;
  }
  if (!fits) {
    return fail(ErrorCode::kInvalidArgument,
                "the processing chain would need more than {} MiB per robot: {} delayed samples of "
                "{} records each and {} filters; shorten the latency, lengthen the period or use "
                "smaller filters",
                kLargestState >> 20, depth, capacity, spec.filters.size());
  }
  made.depth_ = static_cast<std::uint32_t>(depth);
  made.state_size_ = size;
  return made;
}

void Processing::reset(std::byte* state) const noexcept {
  std::memset(state, 0, state_size_);
  if (kind_ != ReadingKind::kRanges) return;
  for (const Stage& stage : stages_) {
    detail::reset_range_filter(stage.filter, capacity_, state + stage.offset);
  }
}

std::byte* Processing::slot(std::byte* state, std::uint32_t index) const noexcept {
  return state + sizeof(Ring) + slot_size_ * (index % depth_);
}

/// Appends a sample to the ring and returns the place of its header.
std::byte* Processing::enqueue(const SampleHeader& raw, const void* records,
                               std::byte* state) const noexcept {
  auto& ring = *reinterpret_cast<Ring*>(state);
  // An irregular source may give more than was reckoned with. The oldest is lost and counted.
  if (ring.count == depth_) {
    const auto& lost = *reinterpret_cast<const SampleHeader*>(slot(state, ring.first));
    ring.dropped += lost.count + lost.dropped;
    ring.first = (ring.first + 1) % depth_;
    --ring.count;
  }
  std::byte* const place = slot(state, ring.first + ring.count);
  ++ring.count;
  auto& header = *reinterpret_cast<SampleHeader*>(place);
  header = raw;
  header.count = std::min(raw.count, capacity_);
  header.dropped += raw.count - header.count;
  if (header.count > 0) {
    std::memcpy(place + sizeof(SampleHeader), records, std::size_t{header.count} * record_size_);
  }
  return place;
}

void Processing::push(const SampleHeader& raw, const void* records, const RandomStream& random,
                      std::byte* state) const noexcept {
  std::byte* const place = enqueue(raw, records, state);
  apply_noise(*reinterpret_cast<SampleHeader*>(place), place + sizeof(SampleHeader), random);
}

void Processing::push_noisy(const SampleHeader& noisy, const void* records,
                            std::byte* state) const noexcept {
  enqueue(noisy, records, state);
}

bool Processing::deliver(SimTime now, std::byte* state, SampleHeader* out,
                         void* out_records) const noexcept {
  return deliver_some(now, true, state, out, out_records);
}

bool Processing::deliver_oldest(SimTime now, std::byte* state, SampleHeader* out,
                                void* out_records) const noexcept {
  return deliver_some(now, false, state, out, out_records);
}

bool Processing::deliver_some(SimTime now, bool all, std::byte* state, SampleHeader* out,
                              void* out_records) const noexcept {
  auto& ring = *reinterpret_cast<Ring*>(state);
  std::byte* newest = nullptr;
  while (ring.count > 0 && (all || newest == nullptr)) {
    std::byte* const place = slot(state, ring.first);
    const auto& header = *reinterpret_cast<const SampleHeader*>(place);
    // Samples are in the order of their stamps, so all behind this one are not due either.
    if (SimTime{header.stamp_ns} + latency_ > now) break;
    // Filters see every sample in order, those too that a newer one replaces: their output would
    // otherwise depend on how often it is read.
    for (const Stage& stage : stages_) filter(stage, header, place + sizeof(SampleHeader), state);
    ring.dropped += header.dropped;
    ring.first = (ring.first + 1) % depth_;
    --ring.count;
    newest = place;
  }
  if (newest == nullptr) return false;
  // Of states only the newest is delivered; what it stands for is not counted as lost.
  *out = *reinterpret_cast<const SampleHeader*>(newest);
  out->dropped = ring.dropped;
  ring.dropped = 0;
  if (out->count > 0) {
    std::memcpy(out_records, newest + sizeof(SampleHeader), std::size_t{out->count} * record_size_);
  }
  return true;
}

void Processing::filter(const Stage& stage, const SampleHeader& header, void* records,
                        std::byte* state) const noexcept {
  std::byte* memory = state + stage.offset;
  if (kind_ == ReadingKind::kRanges) {
    detail::filter_ranges(stage.filter, capacity_, header.stamp_ns,
                          {static_cast<float*>(records), header.count}, memory);
    return;
  }
  detail::FieldFilter run(stage.filter);
  const std::size_t each = detail::filter_memory(stage.filter);
  const detail::FilterFields fields = detail::filter_fields(kind_);
  auto* record = static_cast<double*>(records);
  // Each field of each record has its own state, one behind the other.
  for (std::uint32_t i = 0; i < header.count; ++i, record += record_size_ / sizeof(double)) {
    for (std::uint32_t k = 0; k < fields.count; ++k, memory += each) {
      record[k] = run(record[k], header.stamp_ns, (fields.angles >> k & 1U) != 0, memory);
    }
  }
}

}  // namespace rave
