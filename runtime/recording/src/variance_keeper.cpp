// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/variance_keeper.hpp"

namespace rave::runtime {
namespace {

// Variances change slowly, so ten times a second is enough.
constexpr std::int64_t kLeast_ns = 100'000'000;

}  // namespace

void VarianceKeeper::keep(const sim::Engine& engine, const std::vector<std::uint8_t>& told_truth,
                          record::RunRecorder& recorder) {
  const std::int64_t time_ns = engine.time().ns;
  if (time_ns < due_ns_) return;
  due_ns_ = (time_ns / kLeast_ns + 1) * kLeast_ns;
  now_.clear();
  for (std::uint32_t r = 0; r < told_truth.size(); ++r) {
    if (told_truth[r] != 0 || !engine.is_local(RobotId(r))) continue;
    const sim::ReportedPose& reported = engine.reported(RobotId(r));
    const PoseReading& pose = reported.pose;
    if (!reported.known || (pose.variance_xy_m2 <= 0 && pose.variance_yaw_rad2 <= 0)) continue;
    now_.push_back({RobotId(r), pose.variance_xy_m2, pose.variance_yaw_rad2});
  }
  // Repeated while unchanged, so that a reader that begins in the middle of a recording finds them.
  const bool again = !now_.empty() && time_ns - told_ns_ >= record::kVariancesHold_ns;
  if (now_ == told_ && !again) return;
  // A failed write is reported at the end of the step.
  static_cast<void>(recorder.variances(now_));
  told_.swap(now_);
  told_ns_ = time_ns;
}

}  // namespace rave::runtime
