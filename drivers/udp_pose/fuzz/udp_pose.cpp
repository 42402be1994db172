// SPDX-License-Identifier: Apache-2.0
// Each line is a datagram; they arrive 10 ms after one another.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "rave/base/check.hpp"
#include "udp_pose/pose_stream.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using rave::udp_pose::PoseStream;
  PoseStream stream("robot", 0.2, 2);
  rave::udp_pose::PoseDatagram pose;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  double newest_s = -1e300;
  for (double now_s = 1; !rest.empty(); now_s += 0.01) {
    const auto end = rest.find('\n');
    const auto restarts = stream.state().restarts;
    const auto taken = stream.take(rest.substr(0, end), "here", now_s, pose);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (stream.state().restarts != restarts) newest_s = -1e300;
    if (taken.verdict != PoseStream::Verdict::kAccepted) continue;
    RAVE_CHECK(pose.body == "robot" && pose.t_s > newest_s);
    newest_s = pose.t_s;
    for (const double value : {pose.t_s, pose.x_m, pose.y_m, pose.yaw_rad, taken.host_s}) {
      RAVE_CHECK(std::isfinite(value));
    }
    RAVE_CHECK(std::abs(pose.yaw_rad) <= 3.1415926535897936 && taken.host_s <= now_s + 1e-3);
    if (pose.variance) RAVE_CHECK(pose.variance->x_m2 >= 0 && pose.variance->yaw_rad2 >= 0);
  }
  return 0;
}
