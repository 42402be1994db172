// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <limits>

#include "rave/math/gaussian.hpp"
#include "rave/math/scalar.hpp"
#include "rave/robot/processing.hpp"

namespace rave {
namespace {

/// The normal error and the rounding of one kind of field.
class Term {
 public:
  Term(double sigma, double quantum) noexcept : sigma_(sigma), quantum_(quantum) {}

  /// Always takes what one normal number takes, so that terms do not disturb each other.
  [[nodiscard]] double error(RandomStream& random) const noexcept {
    if (sigma_ > 0) return sigma_ * gaussian(random);
    for (int i = 0; i < 4; ++i) random.bits();
    return 0;
  }
  [[nodiscard]] double rounded(double x) const noexcept {
    return quantum_ > 0 ? std::floor(x / quantum_ + 0.5) * quantum_ : x;
  }

  /// A coordinate or a speed.
  template <class Real>
  void plain(Real& x, RandomStream& random) const noexcept {
    const double wrong = x + error(random);
    x = static_cast<Real>(rounded(wrong));
  }
  /// A distance: never negative. No return stays no return.
  void distance(float& x, RandomStream& random) const noexcept {
    const double wrong = x + error(random);
    if (std::isfinite(x)) x = static_cast<float>(rounded(wrong < 0 ? 0 : wrong));
  }
  template <class Real>
  void angle(Real& x, RandomStream& random) const noexcept {
    const double wrong = x + error(random);
    if (sigma_ > 0 || quantum_ > 0) x = static_cast<Real>(wrap_angle(rounded(wrong)));
  }
  [[nodiscard]] double variance() const noexcept { return sigma_ * sigma_; }

 private:
  double sigma_;
  double quantum_;
};

struct Terms {
  Term length;
  Term angle;
  Term velocity;
};

void disturb(float& range, const Terms& terms, RandomStream& random) noexcept {
  terms.length.distance(range, random);
}
void disturb(Sighting& seen, const Terms& terms, RandomStream& random) noexcept {
  terms.length.distance(seen.range_m, random);
  terms.angle.angle(seen.bearing_rad, random);
}
template <class Posed>
void disturb_pose(Posed& pose, const Terms& terms, RandomStream& random) noexcept {
  terms.length.plain(pose.x_m, random);
  terms.length.plain(pose.y_m, random);
  terms.angle.angle(pose.yaw_rad, random);
  pose.variance_xy_m2 += terms.length.variance();
  pose.variance_yaw_rad2 += terms.angle.variance();
}
void disturb(PoseReading& pose, const Terms& terms, RandomStream& random) noexcept {
  disturb_pose(pose, terms, random);
}
void disturb(OdometryReading& odometry, const Terms& terms, RandomStream& random) noexcept {
  disturb_pose(odometry, terms, random);
  terms.velocity.plain(odometry.v_mps, random);
}
void disturb(NeighbourReading& other, const Terms& terms, RandomStream& random) noexcept {
  terms.length.distance(other.range_m, random);
  terms.angle.angle(other.bearing_rad, random);
  terms.velocity.plain(other.vx_mps, random);
  terms.velocity.plain(other.vy_mps, random);
}
void disturb(VelocityReading& velocity, const Terms& terms, RandomStream& random) noexcept {
  terms.velocity.plain(velocity.v_mps, random);
}

template <class Record>
Record* disturb_all(void* records, std::uint32_t count, const Terms& terms,
                    RandomStream& random) noexcept {
  auto* const first = static_cast<Record*>(records);
  for (std::uint32_t i = 0; i < count; ++i) disturb(first[i], terms, random);
  return first;
}

/// Takes records out, keeping the order of the others; returns how many are left.
template <class Record>
std::uint32_t thin_out(Record* records, std::uint32_t count, double probability,
                       RandomStream& random) noexcept {
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (random.uniform() >= probability) records[kept++] = records[i];
  }
  return kept;
}

void silence(float* rays, std::uint32_t count, double probability, RandomStream& random) noexcept {
  for (std::uint32_t i = 0; i < count; ++i) {
    if (random.uniform() < probability) rays[i] = std::numeric_limits<float>::infinity();
  }
}

}  // namespace

bool NoiseSpec::any() const noexcept {
  return length_sigma_m > 0 || angle_sigma_rad > 0 || velocity_sigma_mps > 0 ||
         length_quantum_m > 0 || angle_quantum_rad > 0 || velocity_quantum_mps > 0 ||
         dropout_probability > 0;
}

void Processing::apply_noise(SampleHeader& header, void* records,
                             RandomStream random) const noexcept {
  if (!noisy_ || header.count == 0) return;
  const Terms terms{{noise_.length_sigma_m, noise_.length_quantum_m},
                    {noise_.angle_sigma_rad, noise_.angle_quantum_rad},
                    {noise_.velocity_sigma_mps, noise_.velocity_quantum_mps}};
  const double lost = noise_.dropout_probability;
  const std::uint32_t count = header.count;
  switch (kind_) {
    case ReadingKind::kRanges: {
      float* const rays = disturb_all<float>(records, count, terms, random);
      if (lost > 0) silence(rays, count, lost, random);
      return;
    }
    case ReadingKind::kSightings: {
      auto* const seen = disturb_all<Sighting>(records, count, terms, random);
      if (lost > 0) header.count = thin_out(seen, count, lost, random);
      return;
    }
    case ReadingKind::kNeighbours: {
      auto* const others = disturb_all<NeighbourReading>(records, count, terms, random);
      if (lost > 0) header.count = thin_out(others, count, lost, random);
      return;
    }
    case ReadingKind::kPose:
      disturb_all<PoseReading>(records, count, terms, random);
      break;
    case ReadingKind::kOdometry:
      disturb_all<OdometryReading>(records, count, terms, random);
      break;
    case ReadingKind::kVelocity:
      disturb_all<VelocityReading>(records, count, terms, random);
      break;
    case ReadingKind::kContact:
    case ReadingKind::kValues:
    case ReadingKind::kNone:
      break;
  }
  if (lost > 0 && random.uniform() < lost) header.count = 0;
}

}  // namespace rave
