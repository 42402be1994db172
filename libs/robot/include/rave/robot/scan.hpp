// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "rave/robot/program.hpp"

namespace rave {

/// One return of a range sensor, in the robot's frame.
struct RangeHit {
  Vec2 p_R;
  double distance_m = 0;   ///< From the robot's origin.
  double bearing_rad = 0;  ///< From the robot's origin, in (-pi, pi].
};

/// One ray or cone of the latest samples, hit or not.
struct RangeBeam {
  Vec2 origin_R;          ///< Where the sensor sits.
  Vec2 direction_R;       ///< Unit vector of the axis.
  double free_m = 0;      ///< Nothing nearer along the axis; the sensor's limit without a return.
  double spread_rad = 0;  ///< Half the opening of a cone; 0 for a ray.
};

/// What all range sensors of a robot say together, in the robot's frame: the same for three sonars
/// and for a laser. A ray gives one hit, a cone three (axis and both edges), because something
/// stands somewhere on its arc. No returns and readings that are not numbers give none. Belongs to
/// the program; update() allocates nothing.
class Scan {
 public:
  Scan() = default;
  /// Takes every range sensor of the robot; none is no error, the scan is then always empty.
  explicit Scan(const Setup& setup);

  /// Reads the latest samples. Call it first in decide().
  void update(const Percepts& percepts);

  [[nodiscard]] std::span<const RangeHit> hits() const noexcept { return hits_; }
  [[nodiscard]] std::span<const RangeBeam> beams() const noexcept { return beams_; }
  /// Whether any of the sensors has said nothing for longer than it may (Percepts::is_old): what
  /// was free then need not be free now.
  [[nodiscard]] bool is_old() const noexcept { return old_; }
  /// Distance from the robot's origin to the nearest hit with a bearing in [from_rad, to_rad];
  /// infinity if there is none.
  [[nodiscard]] double nearest_m(double from_rad, double to_rad) const noexcept;

 private:
  struct Ray {
    Vec2 origin_R;
    Vec2 directions_R[3];  ///< Axis, left edge, right edge.
    double spread_rad = 0;
  };
  struct Sensor {
    RangesHandle handle;
    std::vector<Ray> rays;
  };

  void add(const Ray& ray, float range_m, double limit_m);

  std::vector<Sensor> sensors_;
  std::vector<RangeHit> hits_;
  std::vector<RangeBeam> beams_;
  bool old_ = false;
};

}  // namespace rave
