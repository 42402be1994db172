// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/conductor.hpp"

namespace rave::gui_server {
namespace {

constexpr const char* kNothingRuns = "No run is in progress.";

class EmptyCursor final : public Cursor {
 public:
  Status go_to(double /*time_s*/) override { return {}; }
  [[nodiscard]] const PosesAt& poses() const noexcept override { return poses_; }
  std::vector<ReadingAt> readings(std::span<const LookedAt> /*sensors*/, bool /*parts*/) override {
    return {};
  }

 private:
  PosesAt poses_;
};

class StandingPlayhead final : public Playhead {
 public:
  std::string take(const TransportMessage& /*transport*/, Clock::time_point /*now*/) override {
    return kNothingRuns;
  }
  PlayState look(Clock::time_point /*now*/) override {
    PlayState state;
    state.kind = PlayState::Kind::kEnded;
    state.reason = kNothingRuns;
    return state;
  }
};

class NoRun final : public Source {
 public:
  NoRun() {
    about_.none = true;
    about_.step_s = 1;
  }
  [[nodiscard]] const RunAbout& about() const noexcept override { return about_; }
  [[nodiscard]] Powers powers() const override {
    Powers powers;
    for (const char* const word : {"play", "seek", "pace", "step", "stop", "release", "command",
                                   "edit", "recording", "probe"}) {
      powers.why_not[word] = kNothingRuns;
    }
    // People may talk while they wait.
    powers.may.emplace_back("chat");
    return powers;
  }
  [[nodiscard]] const std::string& bodies_json() const noexcept override { return nothing_; }
  [[nodiscard]] const std::string& robots_json() const noexcept override { return nothing_; }
  [[nodiscard]] std::uint32_t robot_count() const noexcept override { return 0; }
  [[nodiscard]] std::span<const LogEvent> events() const noexcept override { return {}; }
  [[nodiscard]] std::unique_ptr<Cursor> open_cursor() override {
    return std::make_unique<EmptyCursor>();
  }
  [[nodiscard]] std::unique_ptr<Playhead> open_playhead() override {
    return std::make_unique<StandingPlayhead>();
  }
  void halt(const HaltMessage& /*halt*/, const Author& /*author*/, Reply reply) override {
    reply(false, kNothingRuns);
  }

 private:
  RunAbout about_;
  std::string nothing_ = "[]";
};

}  // namespace

std::shared_ptr<Source> no_run() { return std::make_shared<NoRun>(); }

}  // namespace rave::gui_server
