// SPDX-License-Identifier: Apache-2.0
#include "rave/estimate/team_filter.hpp"

namespace rave::estimate {

void TeamFilter::add(const Pose2& X_WR, double position_sigma_m, double heading_sigma_rad,
                     double time_s) {
  robots_.push_back({PoseFilter(motion_, sighting_, X_WR, position_sigma_m, heading_sigma_rad),
                     time_s,
                     time_s,
                     {},
                     {}});
}

void TeamFilter::command(std::size_t robot, double time_s, double v_mps, double w_radps) {
  auto& coming = robots_[robot].coming;
  auto at = coming.end();
  while (at != coming.begin() && (at - 1)->from_s > time_s + motion_.delay_s) --at;
  coming.insert(at, {time_s + motion_.delay_s, v_mps, w_radps});
}

void TeamFilter::advance(std::size_t robot, double time_s) {
  Robot& one = robots_[robot];
  const auto move_to = [&one](double to_s) {
    if (!(to_s > one.now_s)) return;
    one.filter.move(one.current.v_mps, one.current.w_radps, to_s - one.now_s);
    one.now_s = to_s;
  };
  while (!one.coming.empty() && one.coming.front().from_s <= time_s) {
    move_to(one.coming.front().from_s);
    one.current = one.coming.front();
    one.coming.pop_front();
  }
  move_to(time_s);
}

bool TeamFilter::see_landmark(std::size_t robot, double time_s, Vec2 p_WL, double range_m,
                              double bearing_rad) {
  advance(robot, time_s);
  Robot& one = robots_[robot];
  if (!one.filter.see({p_WL, {}}, range_m, bearing_rad)) return false;
  one.seen_s = one.now_s;
  return true;
}

bool TeamFilter::see_robot(std::size_t robot, std::size_t other, double time_s, double range_m,
                           double bearing_rad) {
  advance(robot, time_s);
  advance(other, time_s);
  Robot& one = robots_[robot];
  Robot& two = robots_[other];
  // Both from before: neither is corrected by what the other has just learnt from it.
  const Place from_one = one.filter.project(range_m, bearing_rad);
  if (!one.filter.see(two.filter.place(), range_m, bearing_rad)) return false;
  one.seen_s = one.now_s;
  two.filter.seen_at(from_one);
  return true;
}

}  // namespace rave::estimate
