// SPDX-License-Identifier: Apache-2.0
// The readings of all range sensors of a robot, in its frame.
#include "rave/robot/scan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rave/math/scalar.hpp"
#include "rave/math/transform.hpp"

namespace rave {
namespace {

Vec2 unit(double angle_rad) {
  const SinCos angle = sincos(angle_rad);
  return {angle.cos, angle.sin};
}

}  // namespace

Scan::Scan(const Setup& setup) : radius_m_(setup.robot_radius_m()) {
  std::size_t rays = 0;
  for (const RangesHandle& handle : setup.all_sensors<float>()) {
    const SensorInfo& info = handle.info();
    Sensor sensor{handle, {}};
    if (info.bearings_rad == nullptr) continue;
    for (std::uint32_t i = 0; i < info.capacity; ++i) {
      const double axis_rad = info.X_RS.yaw + info.bearings_rad[i];
      // A cone is its axis and its two edges: the nearest thing may be anywhere in between.
      const double spread_rad = 0.5 * info.cone_rad;
      sensor.rays.push_back(
          {info.X_RS.position(),
           {unit(axis_rad), unit(axis_rad + spread_rad), unit(axis_rad - spread_rad)},
           spread_rad,
           Sectors::between(axis_rad - spread_rad, axis_rad + spread_rad)});
    }
    rays += sensor.rays.size();
    sensors_.push_back(std::move(sensor));
  }
  beams_.reserve(rays);
  hits_.reserve(3 * rays + Sectors::kCount);
}

void Scan::update(const Percepts& percepts) {
  hits_.clear();
  beams_.clear();
  sight_.clear();
  old_ = false;
  for (const Sensor& sensor : sensors_) {
    old_ = old_ || percepts.is_old(sensor.handle);
    const std::span<const float> ranges_m = percepts[sensor.handle];
    const std::size_t count = std::min(ranges_m.size(), sensor.rays.size());
    for (std::size_t i = 0; i < count; ++i) {
      add(sensor.rays[i], ranges_m[i], sensor.handle.info().range_max_m);
    }
  }
  add_blind();
}

/// What it cannot see may be right before it.
void Scan::add_blind() {
  const Sectors ahead = sight_.blind() & Sectors::ahead(kMustSee_rad);
  for (int i = 0; ahead.any() && i < Sectors::kCount; ++i) {
    if (!ahead.has(i)) continue;
    const double bearing_rad = Sectors::middle_rad(i);
    hits_.push_back({radius_m_ * unit(bearing_rad), radius_m_, bearing_rad, true});
  }
}

void Scan::add(const Ray& ray, float range_m, double limit_m) {
  sight_.add(ray.sectors, range_m);
  if (std::isnan(range_m)) return;
  const bool hit = range_m < std::numeric_limits<float>::infinity();
  // Minus infinity means "too near to measure" (REP-117).
  const double free_m = hit ? std::max(static_cast<double>(range_m), 0.0) : limit_m;
  beams_.push_back({ray.origin_R, ray.directions_R[0], free_m, ray.spread_rad});
  if (!hit) return;
  const int edges = ray.spread_rad > 0 ? 3 : 1;
  for (int k = 0; k < edges; ++k) {
    const Vec2 p_R = ray.origin_R + free_m * ray.directions_R[k];
    hits_.push_back({p_R, std::sqrt(squared_norm(p_R)), atan2(p_R.y, p_R.x), false});
  }
}

double Scan::nearest_m(double from_rad, double to_rad) const noexcept {
  double nearest_m = std::numeric_limits<double>::infinity();
  for (const RangeHit& hit : hits_) {
    if (hit.bearing_rad >= from_rad && hit.bearing_rad <= to_rad) {
      nearest_m = std::min(nearest_m, hit.distance_m);
    }
  }
  return nearest_m;
}

}  // namespace rave
