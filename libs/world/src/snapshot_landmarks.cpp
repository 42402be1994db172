// SPDX-License-Identifier: Apache-2.0
// The codes that landmark cameras read on robots.
#include "rave/world/snapshot.hpp"

namespace rave::world {

void Snapshot::find_codes() {
  coded_.clear();
  for (std::uint32_t r = 0; r < model_->robots.size(); ++r) {
    if (model_->robots[r].code) coded_.push_back(r);
  }
}

// Robots that carry codes move, so their landmarks are made anew in each step, behind those of
// obstacles.
void Snapshot::rebuild_landmarks() {
  landmarks_.erase(landmarks_.begin() + static_cast<std::ptrdiff_t>(fixed_landmarks_),
                   landmarks_.end());
  for (const std::uint32_t r : coded_) {
    if (!robots_[r].present) continue;
    const Body& body = model_->robots[r];
    landmarks_.push_back({body_of(RobotId(r)), *body.code, robots_[r].X_WR.position(),
                          body.code_z0_m, body.code_z1_m, RobotId(r), 0});
  }
}

}  // namespace rave::world
