// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "rave/robot/program.hpp"
#include "rave/robot/sight.hpp"

namespace rave {

/// One return of a range sensor, in the robot frame.
struct RangeHit {
  Vec2 p_R;
  double distance_m = 0;   ///< Distance from the robot's origin.
  double bearing_rad = 0;  ///< Direction from the robot's origin, in (-pi, pi].
  /// Nothing was measured there: it stands for a direction ahead in which the robot is blind.
  bool blind = false;
};

/// One ray or cone of the latest samples, with or without a return.
struct RangeBeam {
  Vec2 origin_R;          ///< Position of the sensor.
  Vec2 direction_R;       ///< Unit vector of the axis.
  double free_m = 0;      ///< Free distance along the axis; without a return the sensor's limit.
  double spread_rad = 0;  ///< Half the opening angle of a cone; 0 for a ray.
};

/// The readings of all range sensors of a robot combined, in the robot frame: sonars and lasers
/// look alike. A ray gives one hit, a cone three (axis and both edges), because the obstacle may be
/// anywhere on its arc. No returns and NaN give none. Where every ray is NaN the robot is blind
/// (Sight); ahead of it, within kMustSee_rad, that counts as a hit that touches its body. So no
/// program drives into what its sensors cannot see. Owned by the program; update() does not
/// allocate.
class Scan {
 public:
  Scan() = default;
  /// Uses every range sensor of the robot. Without any, the scan is always empty; that is no error.
  explicit Scan(const Setup& setup);

  /// Reads the latest samples. Call it at the start of decide().
  void update(const Percepts& percepts);

  [[nodiscard]] std::span<const RangeHit> hits() const noexcept { return hits_; }
  [[nodiscard]] std::span<const RangeBeam> beams() const noexcept { return beams_; }
  /// Whether the samples of any of the sensors are too old (Percepts::is_old): space that was free
  /// may be occupied now.
  [[nodiscard]] bool is_old() const noexcept { return old_; }
  /// Distance from the robot's origin to the nearest hit with a bearing in [from_rad, to_rad];
  /// infinity if there is none.
  [[nodiscard]] double nearest_m(double from_rad, double to_rad) const noexcept;
  /// Where the robot is blind, in all directions.
  [[nodiscard]] Sectors blind() const noexcept { return sight_.blind(); }

 private:
  struct Ray {
    Vec2 origin_R;
    Vec2 directions_R[3];  ///< Axis, left edge, right edge.
    double spread_rad = 0;
    Sectors sectors;
  };
  struct Sensor {
    RangesHandle handle;
    std::vector<Ray> rays;
  };

  void add(const Ray& ray, float range_m, double limit_m);
  void add_blind();

  std::vector<Sensor> sensors_;
  double radius_m_ = 0;  ///< Of the robot's body.
  Sight sight_;
  std::vector<RangeHit> hits_;
  std::vector<RangeBeam> beams_;
  bool old_ = false;
};

}  // namespace rave
