// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/pose_filter.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "rave/math/trigonometry.hpp"

namespace rave::estimate {
namespace {

constexpr int kN = PoseFilter::kStates;
using State = Eigen::Matrix<double, kN, 1>;
using Square = Eigen::Matrix<double, kN, kN, Eigen::RowMajor>;
using Matrix2 = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;
using Vector2 = Eigen::Matrix<double, 2, 1>;

/// A doubting filter gets so much more variance at each further refusal, of x, y and heading.
constexpr double kDoubtPosition = 0.02;
constexpr double kDoubtHeading = 0.01;

double wrapped(double angle_rad) {
  const SinCos u = sincos(angle_rad);
  return atan2(u.sin, u.cos);
}

}  // namespace

/// What was measured beside what was expected of it.
struct PoseFilter::Innovation {
  Vector2 difference;
  Eigen::Matrix<double, 2, kN> jacobian;
  Matrix2 noise;
};

PoseFilter::PoseFilter(const MotionModel& motion, const SightingModel& sighting, const Pose2& X_WR,
                       double position_sigma_m, double heading_sigma_rad)
    : motion_(motion), sighting_(sighting), state_{X_WR.x, X_WR.y, X_WR.yaw, motion.turning_share} {
  covariance_[0] = covariance_[5] = position_sigma_m * position_sigma_m;
  covariance_[10] = heading_sigma_rad * heading_sigma_rad;
  covariance_[15] = motion.turning_share_sigma * motion.turning_share_sigma;
}

void PoseFilter::move(double v_mps, double w_radps, double dt_s) {
  Eigen::Map<State> x(state_.data());
  Eigen::Map<Square> P(covariance_.data());
  const double along_m = v_mps * dt_s;
  const double commanded_rad = w_radps * dt_s;
  const double turned_rad = x[3] * commanded_rad;
  // The chord of the arc has the heading of its middle.
  const SinCos u = sincos(x[2] + 0.5 * turned_rad);
  x[0] += along_m * u.cos;
  x[1] += along_m * u.sin;
  x[2] = wrapped(x[2] + turned_rad);

  Square F = Square::Identity();
  F(0, 2) = -along_m * u.sin;
  F(1, 2) = along_m * u.cos;
  F(0, 3) = F(0, 2) * 0.5 * commanded_rad;
  F(1, 3) = F(1, 2) * 0.5 * commanded_rad;
  F(2, 3) = commanded_rad;
  const double along = motion_.along_sigma * motion_.along_sigma * std::abs(along_m);
  const double turn = motion_.turn_sigma * motion_.turn_sigma * std::abs(turned_rad) +
                      motion_.still_sigma * motion_.still_sigma * dt_s;
  const Square moved = F * P * F.transpose();
  P = moved;
  P(0, 0) += along * u.cos * u.cos;
  P(0, 1) += along * u.cos * u.sin;
  P(1, 0) += along * u.cos * u.sin;
  P(1, 1) += along * u.sin * u.sin;
  P(2, 2) += turn;
  P(3, 3) += motion_.share_drift * motion_.share_drift * dt_s;
}

bool PoseFilter::see(const Place& target, double range_m, double bearing_rad) {
  const Vec2 to_W{target.p_W.x - state_[0], target.p_W.y - state_[1]};
  const double squared_m2 = to_W.x * to_W.x + to_W.y * to_W.y;
  if (!std::isfinite(range_m) || !std::isfinite(bearing_rad) || !(squared_m2 > 1e-6)) return false;
  const double expected_m = std::sqrt(squared_m2);
  Innovation innovation;
  innovation.difference << range_m - expected_m,
      wrapped(bearing_rad - (atan2(to_W.y, to_W.x) - state_[2]));
  Matrix2 by_place;  // How the expectation changes with the place of the target.
  by_place << to_W.x / expected_m, to_W.y / expected_m,  //
      -to_W.y / squared_m2, to_W.x / squared_m2;
  innovation.jacobian.setZero();
  innovation.jacobian.leftCols<2>() = -by_place;
  innovation.jacobian(1, 2) = -1;
  const Eigen::Map<const Matrix2> unsure(target.covariance.data());
  innovation.noise = by_place * unsure * by_place.transpose();
  innovation.noise(0, 0) += sighting_.range_sigma_m * sighting_.range_sigma_m;
  innovation.noise(1, 1) += sighting_.bearing_sigma_rad * sighting_.bearing_sigma_rad;
  return correct(innovation);
}

bool PoseFilter::seen_at(const Place& target) {
  Innovation innovation;
  innovation.difference << target.p_W.x - state_[0], target.p_W.y - state_[1];
  innovation.jacobian.setZero();
  innovation.jacobian(0, 0) = 1;
  innovation.jacobian(1, 1) = 1;
  innovation.noise = Eigen::Map<const Matrix2>(target.covariance.data());
  return correct(innovation);
}

bool PoseFilter::correct(const Innovation& innovation) {
  Eigen::Map<State> x(state_.data());
  Eigen::Map<Square> P(covariance_.data());
  const auto& H = innovation.jacobian;
  const Matrix2 S = H * P * H.transpose() + innovation.noise;
  const Matrix2 S_inverse = S.inverse();
  const double squared = innovation.difference.dot(S_inverse * innovation.difference);
  if (!(squared <= sighting_.gate)) {
    if (++refusals_ > sighting_.refusals_until_doubt) {
      P(0, 0) += kDoubtPosition;
      P(1, 1) += kDoubtPosition;
      P(2, 2) += kDoubtHeading;
    }
    return false;
  }
  // One that fits by chance does not end the doubt.
  refusals_ /= 2;
  const Eigen::Matrix<double, kN, 2> K = P * H.transpose() * S_inverse;
  const State corrected = x + K * innovation.difference;
  x = corrected;
  x[2] = wrapped(x[2]);
  // The form of Joseph keeps the covariance symmetric and positive.
  const Square keep = Square::Identity() - K * H;
  const Square after = keep * P * keep.transpose() + K * innovation.noise * K.transpose();
  P = 0.5 * (after + after.transpose());
  return true;
}

Place PoseFilter::place() const noexcept {
  return {{state_[0], state_[1]}, {covariance_[0], covariance_[1], covariance_[4], covariance_[5]}};
}

Place PoseFilter::project(double range_m, double bearing_rad) const {
  const SinCos u = sincos(state_[2] + bearing_rad);
  Eigen::Matrix<double, 2, kN> J = Eigen::Matrix<double, 2, kN>::Zero();
  J(0, 0) = J(1, 1) = 1;
  J(0, 2) = -range_m * u.sin;
  J(1, 2) = range_m * u.cos;
  Matrix2 by_reading;
  by_reading << u.cos, -range_m * u.sin, u.sin, range_m * u.cos;
  Matrix2 R = Matrix2::Zero();
  R(0, 0) = sighting_.range_sigma_m * sighting_.range_sigma_m;
  R(1, 1) = sighting_.bearing_sigma_rad * sighting_.bearing_sigma_rad;
  const Eigen::Map<const Square> P(covariance_.data());
  Place result{{state_[0] + range_m * u.cos, state_[1] + range_m * u.sin}, {}};
  Eigen::Map<Matrix2>(result.covariance.data()) =
      J * P * J.transpose() + by_reading * R * by_reading.transpose();
  return result;
}

}  // namespace rave::estimate
