// SPDX-License-Identifier: Apache-2.0
#include "wishes.hpp"

#include <algorithm>

#include "manager_habits.hpp"
#include "rave/base/names.hpp"
#include "rave/control/world_request.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::manager {
namespace {

using runtime::RunRequest;

/// Who asks is told that it will take a while after this.
constexpr std::chrono::seconds kWishPatience{1};

std::string from_step(const sim::WorldAuthority& authority, std::uint64_t step) {
  const double at_s = static_cast<double>(step) * authority.spec().step.seconds();
  return fmt::format("counts from step {} on, at {:.3f} s", step, at_s);
}

std::string done_text(const RunRequest& request) {
  const std::string whom = request.robot.empty() ? "all robots" : request.robot;
  switch (request.kind) {
    case RunRequest::Kind::kStop:
      return "stopped " + whom;
    case RunRequest::Kind::kRelease:
      return "released " + whom;
    case RunRequest::Kind::kArm:
      return "armed " + whom;
    default:
      return fmt::format("{}: {}: {}", whom, request.key, request.value);
  }
}

/// What an obstacle's event says, with what else is worth telling.
std::string made_text(const sim::WorldAuthority& authority, const sim::ObstacleChange& change) {
  std::string text = fmt::format("`{}`", change.name);
  for (const sim::Event& event : authority.state(false).events) {
    if (sim::is_of_obstacle(event.kind) && event.other == change.id) text = event.text;
  }
  return fmt::format("{} {}", runtime::word_of(change.kind), text);
}

}  // namespace

void Wishes::begin(const sim::WorldAuthority& authority, runtime::RunStatus status) {
  for (const sim::ObstacleChange& change : authority.state().obstacles) limits_.made(change);
  next_step_ = authority.next_step();
  const sim::EngineSpec& spec = authority.spec();
  stopped_.assign(spec.robots.size(), 0);
  if (control_ == nullptr) return;
  for (const sim::RobotSpec& robot : spec.robots) {
    status.robots.push_back({robot.name, spec.types[robot.type].simulated, true, false});
  }
  begun_ = true;
  control_->begin(std::move(status));
}

void Wishes::end() {
  wishes_.clear();
  if (std::exchange(begun_, false)) control_->end();
}

/// Whether a robot, or all, may be armed as far as stops were asked here.
Status Wishes::check_released(const sim::WorldAuthority& authority, RobotId robot) const {
  std::vector<std::string_view> names;
  for (std::uint32_t r = 0; r < stopped_.size(); ++r) {
    const bool meant = !robot.valid() || robot.value() == r;
    if (meant && stopped_[r] != 0) names.emplace_back(authority.spec().robots[r].name);
  }
  if (names.empty()) return {};
  constexpr std::size_t kMany = 12;
  return fail(ErrorCode::kState, "stopped: {}; a stop holds until it is released (`--release`)",
              names.size() > kMany ? fmt::format("{} robots", names.size()) : join_names(names));
}

Result<std::uint64_t> Wishes::pass_on(const RunRequest& request, sim::WorldAuthority& authority) {
  RAVE_TRY_ASSIGN(sim::WorldInput input, runtime::input_of(authority.spec(), request));
  if (input.kind == sim::WorldInput::Kind::kArm) RAVE_TRY(check_released(authority, input.robot));
  if (input.obstacle) {
    RAVE_TRY(limits_.take(*input.obstacle, EditLimits::Clock::now()));
  } else if (wishes_.size() >= EditLimits::kMostOpen) {
    return fail(ErrorCode::kState, "too much waits for the next step; ask again later");
  } else {
    RAVE_TRY(lock_step::check_fits(input));
  }
  return authority.ask(std::move(input));
}

void Wishes::listen(sim::WorldAuthority& authority) {
  if (!begun_) return;
  for (runtime::RunControl::Asked& asked : control_->take()) {
    if (asked.request().kind == RunRequest::Kind::kList) {
      asked.answer(runtime::obstacle_list(authority.world()));
      continue;
    }
    const auto number = pass_on(asked.request(), authority);
    if (!number) {
      asked.answer(fail(number.error().code, "{}", number.error().message));
      continue;
    }
    using Kind = RunRequest::Kind;
    const Kind kind = asked.request().kind;
    const bool obstacle = kind == Kind::kAdd || kind == Kind::kMove || kind == Kind::kRemove;
    wishes_.push_back({std::move(asked), *number, obstacle, std::chrono::steady_clock::now()});
  }
}

void Wishes::put_off(std::string_view why) {
  const auto now = std::chrono::steady_clock::now();
  for (Wish& wish : wishes_) {
    if (now - wish.since < kWishPatience) continue;
    wish.asked.answer(fmt::format(
        "asked for; {}, so it is done, or refused, in step {}: the log of this process will say",
        why, next_step_));
  }
}

void Wishes::answer(Wish& wish, Result<std::string> text) {
  if (log_ != nullptr && text) log_->info("by hand", "{}", *text);
  if (log_ != nullptr && !text) log_->warn("by hand", "refused: {}", text.error().message);
  wish.asked.answer(std::move(text));
}

void Wishes::note_inputs(const sim::WorldStep& world) {
  bool any = false;
  for (const sim::WorldInput& input : world.inputs) {
    const bool stops = input.kind == sim::WorldInput::Kind::kStop;
    if (!stops && input.kind != sim::WorldInput::Kind::kRelease) continue;
    any = true;
    for (std::uint32_t r = 0; r < stopped_.size(); ++r) {
      if (!input.robot.valid() || input.robot.value() == r) stopped_[r] = stops ? 1 : 0;
    }
  }
  if (!any) return;
  control_->refresh([this](runtime::RunStatus& status) {
    for (std::size_t r = 0; r < status.robots.size(); ++r) status.robots[r].stopped = stopped_[r];
  });
}

void Wishes::after_step(const sim::WorldAuthority& authority, const sim::WorldStep& world) {
  limits_.step_done();
  for (const sim::ObstacleChange& change : world.obstacles) limits_.made(change);
  next_step_ = world.step + 1;
  if (!begun_) return;
  control_->set_time(static_cast<double>(world.step) * authority.spec().step.seconds());
  if (wishes_.empty()) return;
  note_inputs(world);
  // Those by hand come before those of the scenario, in the order in which they were asked for.
  auto made = world.obstacles.begin();
  for (Wish& wish : wishes_) {
    const auto refusals = authority.refusals();
    const auto refusal = std::find_if(refusals.begin(), refusals.end(),
                                      [&](const auto& one) { return one.sequence == wish.number; });
    if (refusal != refusals.end()) {
      answer(wish, fail(ErrorCode::kInvalidArgument, "{}", refusal->text));
      continue;
    }
    const bool of_obstacle = wish.obstacle && made != world.obstacles.end();
    const std::string done =
        of_obstacle ? made_text(authority, *made++) : done_text(wish.asked.request());
    answer(wish, fmt::format("{}; {}", done, from_step(authority, world.step)));
  }
  wishes_.clear();
}

}  // namespace rave::manager
