// SPDX-License-Identifier: Apache-2.0
#include "world_requests.hpp"

#include <algorithm>
#include <utility>

#include "manager_habits.hpp"
#include "rave/assemble/obstacles.hpp"
#include "rave/assemble/parameter_key.hpp"
#include "rave/base/names.hpp"
#include "rave/control/world_request.hpp"
#include "rave/protocol/step_messages.hpp"

namespace rave::manager {
namespace {

/// After this time the caller gets the answer that it will take a while.
constexpr std::chrono::seconds kRequestPatience{1};

std::string from_step(const sim::WorldAuthority& authority, std::uint64_t step) {
  const double at_s = static_cast<double>(step) * authority.spec().step.seconds();
  return fmt::format("counts from step {} on, at {:.3f} s", step, at_s);
}

std::string done_text(const request::Request& request) {
  const std::string whom = request.robot.empty() ? "all robots" : request.robot;
  if (request.is<request::Stop>()) return "stopped " + whom;
  if (request.is<request::Release>()) return "released " + whom;
  if (request.is<request::Arm>()) return "armed " + whom;
  const auto* const set = request.as<request::Set>();
  return set != nullptr ? fmt::format("{}: {}: {}", whom, set->key, set->value) : whom;
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

void WorldRequests::begin(const sim::WorldAuthority& authority, runtime::RunStatus status) {
  for (const sim::ObstacleChange& change : authority.state().obstacles) limits_.made(change);
  next_step_ = authority.next_step();
  const sim::EngineSpec& spec = authority.spec();
  stopped_.assign(spec.robots.size(), 0);
  will_be_stopped_ = stopped_;
  if (control_ == nullptr) return;
  for (const sim::RobotSpec& robot : spec.robots) {
    status.robots.push_back({robot.name, spec.types[robot.type].simulated, true, false});
  }
  begun_ = true;
  control_->begin(std::move(status));
}

void WorldRequests::end() {
  requests_.clear();
  if (std::exchange(begun_, false)) control_->end();
}

/// Whether a robot, or all, may be armed as far as stops were asked here: a release that waits for
/// the next step comes before the arming.
Status WorldRequests::check_released(const sim::WorldAuthority& authority, RobotId robot) const {
  std::vector<std::string_view> names;
  for (std::uint32_t r = 0; r < stopped_.size(); ++r) {
    const bool meant = !robot.valid() || robot.value() == r;
    if (meant && will_be_stopped_[r] != 0) names.emplace_back(authority.spec().robots[r].name);
  }
  if (names.empty()) return {};
  constexpr std::size_t kMany = 12;
  return fail(ErrorCode::kState, "stopped: {}; a stop holds until it is released (`--release`)",
              names.size() > kMany ? fmt::format("{} robots", names.size()) : join_names(names));
}

Result<std::uint64_t> WorldRequests::pass_on(const request::Request& request,
                                             sim::WorldAuthority& authority) {
  // The authority numbers the request and sends it with the next world. Each host checks it against
  // its own robots and refuses it in its next report, so the outcome of a change or an order is
  // known one step later.
  RAVE_TRY_ASSIGN(sim::WorldInput input, runtime::input_of(authority.spec(), request));
  if (input.is<request::Arm>()) RAVE_TRY(check_released(authority, input.robot));
  if (const auto* const obstacle = input.as<sim::ObstacleChange>()) {
    RAVE_TRY(limits_.take(*obstacle, EditLimits::Clock::now()));
  } else if (requests_.size() >= EditLimits::kMostOpen) {
    return fail(ErrorCode::kState, "too many requests wait for the next step; try again later");
  } else {
    RAVE_TRY(lock_step::check_fits(input));
  }
  note_stop(input, will_be_stopped_);
  return authority.ask(std::move(input));
}

// A stop latches until a release, and check_released() refuses to arm before that.
bool WorldRequests::note_stop(const sim::WorldInput& input, std::vector<std::uint8_t>& stopped) {
  const bool stops = input.is<request::Stop>();
  if (!stops && !input.is<request::Release>()) return false;
  for (std::uint32_t r = 0; r < stopped.size(); ++r) {
    if (!input.robot.valid() || input.robot.value() == r) stopped[r] = stops ? 1 : 0;
  }
  return true;
}

void WorldRequests::listen(sim::WorldAuthority& authority) {
  if (!begun_) return;
  for (runtime::RunControl::Asked& asked : control_->take()) take(std::move(asked), authority);
}

void WorldRequests::take(runtime::RunControl::Asked asked, sim::WorldAuthority& authority) {
  if (asked.request().is<request::ListObstacles>()) {
    // The list is answered at once: it changes nothing and needs no step.
    return asked.answer(runtime::list_obstacles(authority.world()));
  }
  if (asked.request().is<request::Chat>()) {
    control_->keep_said(asked.request());
    return asked.answer(std::string("added to the recording"));
  }
  if (const Status here = check_for_hosts(asked.request(), authority); !here) {
    return asked.answer(fail(here.error().code, "{}", here.error().message));
  }
  const auto number = pass_on(asked.request(), authority);
  if (!number) return asked.answer(fail(number.error().code, "{}", number.error().message));
  const bool obstacle = asked.request().is<request::Edit>();
  requests_.push_back({std::move(asked), *number, obstacle, std::chrono::steady_clock::now()});
}

Status WorldRequests::check_for_hosts(const request::Request& request,
                                      const sim::WorldAuthority& authority) const {
  const bool of_lease = request::is_of_lease(request.action);
  const std::string_view name = request::name_of(request.action);
  // The terminal and super-users may release a robot that another person drives.
  const bool releases = request.is<request::Release>() && !request.by.empty() && !request.overrides;
  if (!request::is_order(request.action) && !of_lease && !releases) return {};
  if (request.robot.empty()) {
    return fail(ErrorCode::kState, "`{}` is for the hosts of the robots, which keep their leases",
                name);
  }
  RAVE_TRY_ASSIGN(const RobotId robot, runtime::find_robot(authority.spec(), request.robot));
  const auto host = std::ranges::find_if(hosts_, [robot](const config::PlannedHost& one) {
    return std::ranges::find(one.robots, robot.value()) != one.robots.end();
  });
  return fail(ErrorCode::kState, "`{}` is for host `{}` of robot `{}`, which keeps its lease", name,
              host != hosts_.end() ? host->name : "?", request.robot);
}

void WorldRequests::put_off(std::string_view why) {
  const auto now = std::chrono::steady_clock::now();
  for (Pending& pending : requests_) {
    if (now - pending.since < kRequestPatience) continue;
    // The request stays in the list: its outcome is logged when the step is made.
    pending.asked.answer(
        fmt::format("requested; {}, so it is carried out or refused in step {}; the log of this "
                    "process has the result",
                    why, next_step_));
  }
}

void WorldRequests::answer(Pending& pending, Result<std::string> text) {
  if (text) log_->info("by hand", "{}", *text);
  if (!text) log_->warn("by hand", "refused: {}", text.error().message);
  pending.asked.answer(std::move(text));
}

void WorldRequests::note_inputs(const sim::WorldStep& world) {
  bool any = false;
  for (const sim::WorldInput& input : world.inputs) any = note_stop(input, stopped_) || any;
  // What hosts forward was not asked here.
  will_be_stopped_ = stopped_;
  if (!any) return;
  control_->refresh([this](runtime::RunStatus& status) {
    for (std::size_t r = 0; r < status.robots.size(); ++r) status.robots[r].stopped = stopped_[r];
  });
}

void WorldRequests::after_step(const sim::WorldAuthority& authority, const sim::WorldStep& world) {
  limits_.step_done();
  for (const sim::ObstacleChange& change : world.obstacles) limits_.made(change);
  next_step_ = world.step + 1;
  if (!begun_) return;
  control_->set_time(static_cast<double>(world.step) * authority.spec().step.seconds());
  if (!world.inputs.empty()) note_inputs(world);
  if (requests_.empty()) return;
  // Those by hand come before those of the scenario, in the order in which they were asked for.
  auto made = world.obstacles.begin();
  for (Pending& pending : std::exchange(requests_, {})) {
    const auto refusals = authority.refusals();
    const auto refusal = std::find_if(refusals.begin(), refusals.end(), [&](const auto& one) {
      return one.sequence == pending.number;
    });
    if (refusal != refusals.end()) {
      answer(pending, fail(ErrorCode::kInvalidArgument, "{}", refusal->text));
      continue;
    }
    const bool of_obstacle = pending.obstacle && made != world.obstacles.end();
    const std::string done =
        of_obstacle ? made_text(authority, *made++) : done_text(pending.asked.request());
    answer(pending, fmt::format("{}; {}", done, from_step(authority, world.step)));
  }
}

}  // namespace rave::manager
