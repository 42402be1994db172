// SPDX-License-Identifier: Apache-2.0
#include "world_requests.hpp"

#include <algorithm>
#include <utility>

#include "manager_habits.hpp"
#include "rave/assemble/parameter_key.hpp"
#include "rave/base/names.hpp"
#include "rave/control/order_words.hpp"
#include "rave/control/world_request.hpp"
#include "rave/protocol/step_messages.hpp"
#include "rave/sim/orders.hpp"

namespace rave::manager {
namespace {

using runtime::RunRequest;

/// Who asks is told that it will take a while after this.
constexpr std::chrono::seconds kRequestPatience{1};
/// The order of a robot that somebody drives, as engines call it.
constexpr std::string_view kDriven = "drive";

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
      if (runtime::is_order(request.kind)) return runtime::order_answer(request);
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

void WorldRequests::begin(const sim::WorldAuthority& authority, runtime::RunStatus status) {
  for (const sim::ObstacleChange& change : authority.state().obstacles) limits_.made(change);
  next_step_ = authority.next_step();
  const sim::EngineSpec& spec = authority.spec();
  stopped_.assign(spec.robots.size(), 0);
  will_be_stopped_ = stopped_;
  orders_.assign(spec.robots.size(), {});
  order_numbers_.assign(spec.robots.size(), 0);
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

Result<std::uint64_t> WorldRequests::pass_on(const RunRequest& request,
                                             sim::WorldAuthority& authority) {
  // The authority numbers the request and sends it with the next world. Each host checks it against
  // its own robots and refuses it in its next report, so the outcome of a change or an order is
  // known one step later.
  RAVE_TRY_ASSIGN(sim::WorldInput input, runtime::input_of(authority.spec(), request));
  if (input.kind == sim::WorldInput::Kind::kArm) RAVE_TRY(check_released(authority, input.robot));
  if (input.obstacle) {
    RAVE_TRY(limits_.take(*input.obstacle, EditLimits::Clock::now()));
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
  const bool stops = input.kind == sim::WorldInput::Kind::kStop;
  if (!stops && input.kind != sim::WorldInput::Kind::kRelease) return false;
  for (std::uint32_t r = 0; r < stopped.size(); ++r) {
    if (!input.robot.valid() || input.robot.value() == r) stopped[r] = stops ? 1 : 0;
  }
  return true;
}

void WorldRequests::listen(sim::WorldAuthority& authority) {
  if (!begun_) return;
  // Leases expire with time, also if no request arrives.
  if (desk_.waits()) {
    desk_.tick(
        [&](const RunRequest& request) -> Result<std::string> {
          RAVE_TRY(pass_on(request, authority));
          return std::string();
        },
        runtime::OrderDesk::Time::clock::now());
    tell_leases();
  }
  for (runtime::RunControl::Asked& asked : control_->take()) take(std::move(asked), authority);
}

void WorldRequests::take(runtime::RunControl::Asked asked, sim::WorldAuthority& authority) {
  if (asked.request().kind == RunRequest::Kind::kList) {
    // The list is answered at once: it changes nothing and needs no step.
    return asked.answer(runtime::obstacle_list(authority.world()));
  }
  if (asked.request().kind == RunRequest::Kind::kChat) {
    control_->keep_said(asked.request());
    return asked.answer(std::string("added to the recording"));
  }
  if (runtime::OrderDesk::is_for(asked.request().kind)) {
    return take_order(std::move(asked), authority);
  }
  const auto number = pass_on(asked.request(), authority);
  if (!number) return asked.answer(fail(number.error().code, "{}", number.error().message));
  const bool obstacle = asked.request().kind == RunRequest::Kind::kEdit;
  requests_.push_back(
      {std::move(asked), *number, obstacle, false, false, std::chrono::steady_clock::now()});
}

void WorldRequests::take_order(runtime::RunControl::Asked asked, sim::WorldAuthority& authority) {
  const RunRequest request = asked.request();
  if (!request.robot.empty()) {
    const auto robot = runtime::find_robot(authority.spec(), request.robot);
    // The desk knows leases by name only, so an unknown robot must not get one.
    if (!robot) return asked.answer(fail(robot.error().code, "{}", robot.error().message));
  }
  std::uint64_t number = 0;
  auto answer = desk_.serve(
      request,
      [&](const RunRequest& input) -> Result<std::string> {
        RAVE_TRY_ASSIGN(number, pass_on(input, authority));
        return std::string();
      },
      [&](const std::string& robot) { return is_driven(authority, robot); },
      runtime::OrderDesk::Time::clock::now());
  tell_leases();
  // What ends with a lease that changes hands is nobody's request.
  const bool of_lease =
      request.kind == RunRequest::Kind::kTake || request.kind == RunRequest::Kind::kGive;
  if (!answer || number == 0 || of_lease) return asked.answer(std::move(answer));
  requests_.push_back({std::move(asked), number, false, runtime::is_order(request.kind), false,
                       std::chrono::steady_clock::now()});
}

bool WorldRequests::is_driven(const sim::WorldAuthority& authority, const std::string& name) const {
  const auto robot = runtime::find_robot(authority.spec(), name);
  return robot && orders_[robot->value()] == kDriven;
}

void WorldRequests::tell_leases() {
  const auto changes = desk_.take_changes();
  if (changes.empty()) return;
  for (const runtime::HostLeases::Change& change : changes) {
    if (log_ != nullptr) {
      log_->info("robot " + change.robot, "lease: {}", runtime::lease_text(change));
    }
  }
  control_->refresh([this](runtime::RunStatus& status) { show_orders(status); });
}

void WorldRequests::show_orders(runtime::RunStatus& status) const {
  for (std::size_t r = 0; r < status.robots.size(); ++r) {
    runtime::RunStatus::Robot& robot = status.robots[r];
    robot.lease = desk_.holder(robot.name);
    robot.lease_page = desk_.page(robot.name);
    robot.order = orders_[r];
  }
}

void WorldRequests::put_off(std::string_view why) {
  const auto now = std::chrono::steady_clock::now();
  for (Pending& pending : requests_) {
    if (now - pending.since < kRequestPatience) continue;
    // The request stays in the list: its outcome is logged when the step is made.
    pending.asked.answer(
        fmt::format("requested; {}, so it is carried out or refused in step {}; the log of this "
                    "process tells the result",
                    why, next_step_));
  }
}

void WorldRequests::answer(Pending& pending, Result<std::string> text) {
  if (log_ != nullptr && text) log_->info("by hand", "{}", *text);
  if (log_ != nullptr && !text) log_->warn("by hand", "refused: {}", text.error().message);
  pending.asked.answer(std::move(text));
}

/// What robots do for people, as far as it was asked here.
void WorldRequests::note_order(const sim::WorldInput& input) {
  using Kind = sim::WorldInput::Kind;
  const bool ends = input.kind == Kind::kStop || input.kind == Kind::kCancel;
  const bool moves =
      input.kind == Kind::kDrive || input.kind == Kind::kGoal || input.kind == Kind::kPath;
  if (!ends && !moves) return;
  for (std::uint32_t r = 0; r < orders_.size(); ++r) {
    if (input.robot.valid() && input.robot.value() != r) continue;
    orders_[r] = ends                         ? std::string()
                 : input.kind == Kind::kDrive ? std::string(kDriven)
                                              : sim::order_text(input);
    order_numbers_[r] = input.sequence;
  }
}

void WorldRequests::note_inputs(const sim::WorldAuthority& authority, const sim::WorldStep& world) {
  bool any = false;
  // What a host has refused in the step before, its robot does not do.
  for (const sim::InputRefusal& refusal : authority.refusals()) {
    for (std::uint32_t r = 0; r < orders_.size(); ++r) {
      // A later order may have replaced the refused one.
      if (order_numbers_[r] != refusal.sequence || orders_[r].empty()) continue;
      orders_[r].clear();
      any = true;
    }
  }
  for (const sim::WorldInput& input : world.inputs) {
    note_order(input);
    any = note_stop(input, stopped_) || any || sim::is_order(input.kind);
  }
  if (!any) return;
  control_->refresh([this](runtime::RunStatus& status) {
    for (std::size_t r = 0; r < status.robots.size(); ++r) status.robots[r].stopped = stopped_[r];
    show_orders(status);
  });
}

void WorldRequests::after_step(const sim::WorldAuthority& authority, const sim::WorldStep& world) {
  limits_.step_done();
  for (const sim::ObstacleChange& change : world.obstacles) limits_.made(change);
  next_step_ = world.step + 1;
  if (!begun_) return;
  control_->set_time(static_cast<double>(world.step) * authority.spec().step.seconds());
  if (!world.inputs.empty() || !authority.refusals().empty()) note_inputs(authority, world);
  if (requests_.empty()) return;
  // Those by hand come before those of the scenario, in the order in which they were asked for.
  auto made = world.obstacles.begin();
  std::vector<Pending> later;
  for (Pending& pending : requests_) {
    // A host refuses an order in its next report. So an order is kept for one more step (`told`)
    // before it counts as accepted.
    const auto refusals = authority.refusals();
    const auto refusal = std::find_if(refusals.begin(), refusals.end(), [&](const auto& one) {
      return one.sequence == pending.number;
    });
    if (refusal != refusals.end()) {
      answer(pending, fail(ErrorCode::kInvalidArgument, "{}", refusal->text));
      continue;
    }
    if (pending.order && !std::exchange(pending.told, true)) {
      later.push_back(std::move(pending));
      continue;
    }
    const bool of_obstacle = pending.obstacle && made != world.obstacles.end();
    const std::string done =
        of_obstacle ? made_text(authority, *made++) : done_text(pending.asked.request());
    const std::uint64_t from = pending.order ? world.step - 1 : world.step;
    answer(pending, fmt::format("{}; {}", done, from_step(authority, from)));
  }
  requests_ = std::move(later);
}

}  // namespace rave::manager
