// SPDX-License-Identifier: Apache-2.0
// Noise of the robot file, for many samples at once. Each number has a fixed place in the stream of
// its sample; see docs/explanation/determinism.md.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "noise_batch.hpp"
#include "range_kernel.hpp"
#include "rave/math/scalar.hpp"
#include "rave/robot/processing.hpp"
#include "reading_table.hpp"

namespace rave {
namespace {

using detail::NoiseBatch;
using detail::NoisePiece;
using Items = std::span<const NoiseItem>;

/// Blocks of a sample's stream: normal numbers from the start on, drop-out from the middle on.
constexpr std::uint32_t kNormalBlock = 0;
constexpr std::uint32_t kDropoutBlock = 0x8000'0000U;

/// Gaussian noise and quantisation of one kind of field.
class Term {
 public:
  Term(double sigma, double quantum) noexcept : sigma_(sigma), quantum_(quantum) {}

  [[nodiscard]] bool scatters() const noexcept { return sigma_ > 0; }
  [[nodiscard]] bool rounds() const noexcept { return quantum_ > 0; }
  [[nodiscard]] double variance() const noexcept { return sigma_ * sigma_; }

  /// A coordinate or a speed.
  template <class Real>
  void plain(Real& x, float normal) const noexcept {
    x = static_cast<Real>(rounded(x + sigma_ * double{normal}));
  }
  /// A distance: never negative. No return stays unchanged.
  void distance(float& x, float normal) const noexcept {
    const double wrong = double{x} + sigma_ * double{normal};
    if (std::isfinite(x)) x = static_cast<float>(rounded(wrong < 0 ? 0 : wrong));
  }
  template <class Real>
  void angle(Real& x, float normal) const noexcept {
    // Wrapping alone could change the bits of an angle that has no noise.
    if (!scatters() && !rounds()) return;
    x = static_cast<Real>(wrap_angle(rounded(x + sigma_ * double{normal})));
  }

 private:
  [[nodiscard]] double rounded(double x) const noexcept {
    return quantum_ > 0 ? std::floor(x / quantum_ + 0.5) * quantum_ : x;
  }

  double sigma_;
  double quantum_;
};

struct Terms {
  Term length;
  Term angle;
  Term velocity;

  [[nodiscard]] bool scatter() const noexcept {
    return length.scatters() || angle.scatters() || velocity.scatters();
  }
  [[nodiscard]] bool round() const noexcept {
    return length.rounds() || angle.rounds() || velocity.rounds();
  }
};

template <ReadingKind kKind>
constexpr ReadingType kType = detail::kReadingTypes[static_cast<std::size_t>(kKind)];

/// Normal numbers of the first fields of a record: one for each that noise can change.
/// The numbers are part of the run hash: another order, or one number more, changes all noise.
constexpr std::uint32_t normals_of(std::span<const ReadingField> fields) noexcept {
  return static_cast<std::uint32_t>(std::ranges::count_if(
      fields, [](const ReadingField& field) { return field.noise != NoiseTerm::kNone; }));
}

constexpr std::size_t place_of(std::span<const ReadingField> fields, std::string_view name) {
  std::size_t at = 0;
  while (fields[at].name != name) ++at;
  return at;
}

/// Whether one of `fields` has the variance of that name.
constexpr bool varies(std::span<const ReadingField> fields, std::string_view name) noexcept {
  return std::ranges::any_of(fields,
                             [name](const ReadingField& field) { return field.variance == name; });
}

template <NoiseTerm kNoise>
const Term& term_of(const Terms& terms) noexcept {
  if constexpr (kNoise == NoiseTerm::kAngle) return terms.angle;
  if constexpr (kNoise == NoiseTerm::kVelocity) return terms.velocity;
  return terms.length;
}

/// All but the numbers is known to the compiler.
template <ReadingKind kKind, std::size_t kField>
void disturb_field(std::byte* record, const Terms& terms, const float* normals) noexcept {
  constexpr std::span<const ReadingField> kFields = kType<kKind>.fields;
  constexpr ReadingField kIt = kFields[kField];
  if constexpr (kIt.noise != NoiseTerm::kNone) {
    using Number = std::conditional_t<kIt.format == NumberFormat::kFloat32, float, double>;
    static_assert(kIt.format == NumberFormat::kFloat32 || kIt.format == NumberFormat::kFloat64);
    const Term& term = term_of<kIt.noise>(terms);
    const float normal = normals[normals_of(kFields.first(kField))];
    auto& x = *reinterpret_cast<Number*>(record + kIt.offset);
    if constexpr (kIt.noise == NoiseTerm::kDistance) {
      term.distance(x, normal);
    } else if constexpr (kIt.noise == NoiseTerm::kAngle) {
      term.angle(x, normal);
    } else {
      term.plain(x, normal);
    }
    // Noise of the file is known, so the reading says so; variances of independent errors add. One
    // variance may stand for several fields.
    if constexpr (!kIt.variance.empty() && !varies(kFields.first(kField), kIt.variance)) {
      constexpr ReadingField kVariance = kFields[place_of(kFields, kIt.variance)];
      static_assert(kVariance.format == NumberFormat::kFloat64);
      *reinterpret_cast<double*>(record + kVariance.offset) += term.variance();
    }
  }
}

template <ReadingKind kKind>
void disturb(std::byte* record, const Terms& terms, const float* normals) noexcept {
  [&]<std::size_t... kField>(std::index_sequence<kField...>) {
    (disturb_field<kKind, kField>(record, terms, normals), ...);
  }(std::make_index_sequence<kType<kKind>.fields.size()>());
}

template <ReadingKind kKind>
void disturb_all(Items items, const Terms& terms) noexcept {
  constexpr std::uint32_t kEach = normals_of(kType<kKind>.fields);
  constexpr std::size_t kBytes = kType<kKind>.record_bytes;
  if constexpr (kEach > 0) {
    if (terms.scatter()) {
      const auto use = [&terms](const NoisePiece& piece, const float* normals) {
        std::byte* record = piece.records<std::byte[kBytes]>()[0];
        for (std::uint32_t i = 0; i < piece.count; ++i, record += kBytes, normals += kEach) {
          disturb<kKind>(record, terms, normals);
        }
      };
      NoiseBatch<float, kEach, decltype(use)> batch(kNormalBlock, use);
      for (const NoiseItem& item : items) batch.add(item, item.header->count);
      return;
    }
    if (!terms.round()) return;
    // Rounding without noise draws no random numbers.
    constexpr float kNothing[kEach] = {};
    for (const NoiseItem& item : items) {
      auto* record = static_cast<std::byte*>(item.records);
      for (std::uint32_t i = 0; i < item.header->count; ++i, record += kBytes) {
        disturb<kKind>(record, terms, kNothing);
      }
    }
  }
}

void disturb_ranges(Items items, const NoiseSpec& noise, const RangeLimits& limits) noexcept {
  const double quantum_m = noise.length_quantum_m;
  const auto min_m = static_cast<float>(limits.min_m);
  const auto max_m = static_cast<float>(limits.max_m);
  const auto finish = [=](float* ranges_m, std::uint32_t count) {
    // Noise, then rounding, then the limits of the sensor, as in a real one.
    if (quantum_m > 0) detail::round_ranges(ranges_m, count, quantum_m);
    detail::limit_ranges(ranges_m, count, min_m, max_m);
  };
  if (noise.length_sigma_m > 0) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    const auto sigma_m = static_cast<float>(std::min(noise.length_sigma_m, kLargest));
    const auto use = [sigma_m, &finish](const NoisePiece& piece, const float* normals) {
      auto* const ranges_m = piece.records<float>();
      detail::scatter_ranges(ranges_m, piece.count, sigma_m, normals);
      finish(ranges_m, piece.count);
    };
    NoiseBatch<float, 1, decltype(use)> batch(kNormalBlock, use);
    for (const NoiseItem& item : items) batch.add(item, item.header->count);
  } else if (quantum_m > 0) {
    for (const NoiseItem& item : items) {
      finish(static_cast<float*>(item.records), item.header->count);
    }
  }
}

/// A record is lost if its random word is at most this.
/// P(word <= limit) = (limit + 1) / 2^32.
std::uint32_t dropout_limit(double probability) noexcept {
  return static_cast<std::uint32_t>(std::ceil(probability * 0x1p32) - 1);
}

/// Calls `use(piece, words)` with one word for each of `count(item)` records.
template <class Count, class Use>
void drop_out(Items items, Count count, Use use) noexcept {
  NoiseBatch<std::uint32_t, 1, Use> batch(kDropoutBlock, use);
  for (const NoiseItem& item : items) batch.add(item, count(item));
}

std::uint32_t all_records(const NoiseItem& item) noexcept { return item.header->count; }
std::uint32_t one_record(const NoiseItem& /*item*/) noexcept { return 1; }

void silence(Items items, std::uint32_t limit) noexcept {
  drop_out(items, all_records, [limit](const NoisePiece& piece, const std::uint32_t* words) {
    detail::silence_ranges(piece.records<float>(), piece.count, words, limit);
  });
}

/// Removes records, keeping the order of the others.
void thin_out(Items items, std::size_t bytes, std::uint32_t limit) noexcept {
  drop_out(items, all_records, [=](const NoisePiece& piece, const std::uint32_t* words) {
    auto* const records = static_cast<std::byte*>(piece.item->records);
    std::uint32_t& kept = piece.item->header->count;
    // A sample may come in several pieces. Records move forward only, so no piece overwrites what
    // is still to be read.
    if (piece.first == 0) kept = 0;
    for (std::uint32_t i = 0; i < piece.count; ++i) {
      if (words[i] <= limit) continue;
      std::memmove(records + bytes * kept++, records + bytes * (piece.first + i), bytes);
    }
  });
}

void empty_samples(Items items, std::uint32_t limit) noexcept {
  drop_out(items, one_record, [limit](const NoisePiece& piece, const std::uint32_t* words) {
    if (words[0] <= limit) piece.item->header->count = 0;
  });
}

void lose(ReadingKind kind, Items items, std::uint32_t limit) noexcept {
  const ReadingType& type = reading_type(kind);
  if (kind == ReadingKind::kRanges) return silence(items, limit);
  if (type.shape == ReadingShape::kList) return thin_out(items, type.record_bytes, limit);
  empty_samples(items, limit);
}

/// Ranges have a way of their own, in vectors.
void disturb_kind(ReadingKind kind, Items items, const Terms& terms) noexcept {
  const auto number = static_cast<std::size_t>(kind);
  [&]<std::size_t... kKind>(std::index_sequence<kKind...>) {
    (static_cast<void>(number == kKind &&
                       (disturb_all<static_cast<ReadingKind>(kKind)>(items, terms), true)),
     ...);
  }(std::make_index_sequence<detail::kReadingKinds>());
}

}  // namespace

bool NoiseSpec::any() const noexcept {
  return length_sigma_m > 0 || angle_sigma_rad > 0 || velocity_sigma_mps > 0 ||
         length_quantum_m > 0 || angle_quantum_rad > 0 || velocity_quantum_mps > 0 ||
         dropout_probability > 0;
}

void Processing::apply_noise(SampleHeader& header, void* records,
                             const RandomStream& random) const noexcept {
  const NoiseItem item{&header, records, random};
  apply_noise({&item, 1});
}

void Processing::apply_noise(std::span<const NoiseItem> items) const noexcept {
  if (!noisy_) return;
  const Terms terms{{noise_.length_sigma_m, noise_.length_quantum_m},
                    {noise_.angle_sigma_rad, noise_.angle_quantum_rad},
                    {noise_.velocity_sigma_mps, noise_.velocity_quantum_mps}};
  if (kind_ == ReadingKind::kRanges) {
    disturb_ranges(items, noise_, limits_);
  } else {
    disturb_kind(kind_, items, terms);
  }
  // After the noise, which has the number of records that the sensor gave: drop-out changes it.
  if (noise_.dropout_probability > 0) lose(kind_, items, dropout_limit(noise_.dropout_probability));
}

}  // namespace rave
