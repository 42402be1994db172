// SPDX-License-Identifier: Apache-2.0
#include "replay/replay_playhead.hpp"

#include <algorithm>
#include <cmath>

namespace rave::gui_server {
namespace {

constexpr double kSlowest = 1.0 / 64;
constexpr double kFastest = 64;

}  // namespace

ReplayPlayhead::ReplayPlayhead(const RunAbout& about, Clock::time_point now)
    : about_(about), at_s_(about.begin_s), since_(now) {}

double ReplayPlayhead::due_s(Clock::time_point now) const {
  if (!running_) return at_s_;
  const double gone_s = std::chrono::duration<double>(now - since_).count();
  return std::min(at_s_ + pace_ * gone_s, about_.end_s);
}

void ReplayPlayhead::go_to(double time_s, Clock::time_point now) {
  const double before_s = at_s_;
  at_s_ = std::clamp(time_s, about_.begin_s, about_.end_s);
  since_ = now;
  ++picture_;
  if (at_s_ < before_s || at_s_ > before_s + 1) jumped_ = true;
}

std::string ReplayPlayhead::take(const TransportMessage& transport, Clock::time_point now) {
  using Do = TransportMessage::Do;
  at_s_ = due_s(now);
  since_ = now;
  switch (transport.what) {
    case Do::kPlay:
      running_ = true;
      // At the end, play begins anew.
      if (at_s_ >= about_.end_s) go_to(about_.begin_s, now);
      break;
    case Do::kPause:
      running_ = false;
      break;
    case Do::kStep: {
      running_ = false;
      // From the step that is shown, since a page counts in steps.
      const double shown_s = std::floor(at_s_ / about_.step_s + 0.5) * about_.step_s;
      go_to(shown_s + std::round(transport.value) * about_.step_s, now);
      break;
    }
    case Do::kSeek:
      go_to(transport.value, now);
      break;
    case Do::kPace:
      pace_ = std::clamp(transport.value, kSlowest, kFastest);
      break;
  }
  return {};
}

PlayState ReplayPlayhead::look(Clock::time_point now) {
  const double due = due_s(now);
  if (running_) ++picture_;
  if (running_ && due >= about_.end_s) {
    at_s_ = due;
    since_ = now;
    running_ = false;
  }
  PlayState state;
  state.now_s = due;
  state.begin_s = about_.begin_s;
  state.end_s = about_.end_s;
  state.duration_s = about_.duration_s;
  const bool at_end = !running_ && due >= about_.end_s;
  state.kind = running_ ? PlayState::Kind::kRunning
                        : (at_end ? PlayState::Kind::kEnded : PlayState::Kind::kPaused);
  state.pace = pace_;
  state.speed = running_ ? pace_ : 0;
  state.picture = picture_;
  state.jumped = jumped_;
  jumped_ = false;
  return state;
}

}  // namespace rave::gui_server
