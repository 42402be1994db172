// SPDX-License-Identifier: Apache-2.0
// The host of a robot decides who may order it about; the authority decides from which step on an
// order counts. So an order is checked here, waits for the next world, and is answered when its
// step is done.
#include "input_post.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "rave/assemble/parameter_key.hpp"
#include "rave/base/control_characters.hpp"
#include "rave/base/names.hpp"
#include "rave/control/order_words.hpp"
#include "rave/control/requests.hpp"
#include "rave/protocol/step_messages.hpp"
#include "rave/robot/order.hpp"

namespace rave::runtime {
namespace {

/// After this time the caller gets the answer that it will take a while.
constexpr std::chrono::seconds kAskedPatience{1};

/// A report with anything else would be void for those that read it.
Status check_author(const std::string& by) {
  if (by.size() <= kMostOrderAuthor && !has_control_characters(by)) return {};
  return fail(ErrorCode::kInvalidArgument,
              "the name of the author has {} bytes, or control characters; expected at most {}",
              by.size(), kMostOrderAuthor);
}

/// Of a path, which may be long.
std::size_t points_of(const sim::WorldInput& input) {
  const auto* const path = input.as<request::Path>();
  return path != nullptr ? path->points_W.size() : 0;
}

}  // namespace

std::string InputPost::name_of(RobotId robot) const {
  return engine_.spec().robots[robot.value()].name;
}

std::string InputPost::names_of(const std::vector<RobotId>& robots) const {
  constexpr std::size_t kMany = 12;
  if (robots.size() > kMany) return fmt::format("{} robots", robots.size());
  std::vector<std::string> names;
  for (const RobotId robot : robots) names.push_back(name_of(robot));
  return join_names(std::vector<std::string_view>(names.begin(), names.end()));
}

Result<std::vector<RobotId>> InputPost::meant(const request::Request& request) const {
  if (!request.robot.empty()) {
    RAVE_TRY_ASSIGN(const RobotId robot, find_robot_here(engine_, request.robot));
    return std::vector{robot};
  }
  std::vector<RobotId> robots;
  for (std::uint32_t r = 0; r < engine_.spec().robots.size(); ++r) {
    if (engine_.is_local(RobotId(r))) robots.emplace_back(r);
  }
  return robots;
}

bool InputPost::will_be_stopped(RobotId robot) const {
  const auto hold = std::find_if(waiting_.rbegin(), waiting_.rend(), [robot](const Waiting& one) {
    return one.input.robot == robot &&
           (one.input.is<request::Stop>() || one.input.is<request::Release>());
  });
  return hold != waiting_.rend() ? hold->input.is<request::Stop>() : engine_.stopped(robot);
}

/// Whether what holds a robot changes before the next step, so that only that step can tell whether
/// it may move.
bool InputPost::is_held_anew(RobotId robot) const {
  return std::ranges::any_of(waiting_, [robot](const Waiting& one) {
    return one.input.robot == robot && one.input.is_hold();
  });
}

bool InputPost::is_driven(const std::string& name) const {
  const auto robot = find_robot(engine_.spec(), name);
  if (!robot) return false;
  const auto last = std::find_if(waiting_.rbegin(), waiting_.rend(), [&](const Waiting& one) {
    const sim::WorldInput& input = one.input;
    return input.robot == *robot && !input.is<request::Text>() && !input.is<request::Place>();
  });
  if (last != waiting_.rend()) return last->input.is<request::Drive>();
  return engine_.order_of(*robot) == "drive";
}

Status InputPost::check_room(const std::vector<sim::WorldInput>& inputs) const {
  std::size_t points = 0;
  for (const Waiting& one : waiting_) points += points_of(one.input);
  for (const sim::WorldInput& input : inputs) {
    points += points_of(input);
    RAVE_TRY(lock_step::check_fits(input));
  }
  if (waiting_.size() + inputs.size() <= kMostWaiting && points <= kMostPoints) return {};
  return fail(ErrorCode::kState, "too many requests wait for the next step; try again later");
}

Result<std::string> InputPost::give(const request::Request& request) {
  return request::is_order(request.action) ? give_order(request) : give_hold(request);
}

/// A stop, a release or an arming, for each robot by itself: requests for other hosts do not come
/// here.
Result<std::string> InputPost::give_hold(const request::Request& request) {
  RAVE_TRY_ASSIGN(const std::vector<RobotId> robots, meant(request));
  std::vector<RobotId> stopped;
  std::vector<RobotId> free;
  for (const RobotId robot : robots) (will_be_stopped(robot) ? stopped : free).push_back(robot);
  std::vector<RobotId> its = request.is<request::Stop>() ? free : stopped;
  std::string text = "stopped " + names_of(robots);
  if (request.is<request::Release>()) {
    text = its.empty() ? "nothing to release: no robot is stopped" : "released " + names_of(its);
  } else if (request.is<request::Arm>()) {
    if (!stopped.empty()) {
      return fail(ErrorCode::kState, "stopped: {}; a stop holds until it is released (`--release`)",
                  names_of(stopped));
    }
    its = free;
    std::erase_if(its, [this](RobotId robot) { return engine_.armed(robot); });
    text = its.empty() ? "nothing to arm: no robot waits to be armed" : "armed " + names_of(its);
  }
  RAVE_TRY_ASSIGN(const sim::WorldInput hold, input_for(engine_.spec(), request));
  std::vector<sim::WorldInput> inputs;
  for (const RobotId robot : its) inputs.emplace_back(hold).robot = robot;
  RAVE_TRY(check_author(request.by));
  if (!request.is<request::Stop>()) RAVE_TRY(check_room(inputs));
  return queue(std::move(inputs), std::move(text));
}

Result<std::string> InputPost::give_order(const request::Request& request) {
  RAVE_TRY_ASSIGN(const std::vector<RobotId> robots, meant(request));
  RAVE_TRY_ASSIGN(const sim::WorldInput order, input_for(engine_.spec(), request));
  // With a robot there is one; only a cancellation may be without.
  std::vector<sim::WorldInput> inputs;
  for (const RobotId robot : robots) inputs.emplace_back(order).robot = robot;
  if (inputs.empty()) return order_answer(request);
  const Status may = check_order_now(engine_, inputs.front());
  // By the step for which it waits, what holds the robot now may be over.
  const bool later = !may && may.error().code == ErrorCode::kState && is_held_anew(robots.front());
  if (!may && !later) return tl::unexpected(may.error());
  RAVE_TRY(check_room(inputs));
  return queue(std::move(inputs), order_answer(request));
}

std::string InputPost::queue(std::vector<sim::WorldInput> inputs, std::string text) {
  if (inputs.empty()) return text;
  given_ = ++requested_;
  requests_[*given_].open = inputs.size();
  requests_[*given_].text = text;
  for (sim::WorldInput& input : inputs) {
    input.sequence = ++number_;
    waiting_.push_back({std::move(input), *given_});
  }
  return text;
}

void InputPost::await(std::uint64_t given, RunControl::Asked asked, std::string text) {
  const auto request = requests_.find(given);
  if (request == requests_.end()) return asked.answer(std::move(text));
  request->second.asked.emplace(std::move(asked));
  request->second.text = std::move(text);
}

void InputPost::put(sim::HostReport& report) const {
  for (std::size_t i = report.inputs.size(); i < waiting_.size(); ++i) {
    report.inputs.push_back(waiting_[i].input);
  }
}

void InputPost::take(const sim::WorldStep& world) {
  step_ = world.step;
  bool any = false;
  for (const sim::InputAnswer& answer : world.answers) {
    if (answer.host != host_) continue;
    const auto one = std::ranges::lower_bound(
        waiting_, answer.asked, {}, [](const Waiting& waiting) { return waiting.input.sequence; });
    if (one == waiting_.end() || one->input.sequence != answer.asked || one->answered) continue;
    one->answered = any = true;
    const auto refusal =
        std::ranges::find(world.refusals, answer.sequence, &sim::InputRefusal::sequence);
    if (refusal != world.refusals.end()) {
      end(one->given, refusal->text);
    } else {
      made_.push_back({answer.sequence, one->given});
    }
  }
  if (any) std::erase_if(waiting_, [](const Waiting& one) { return one.answered; });
}

bool InputPost::settle(const std::vector<sim::InputRefusal>& refused) {
  for (const Made& made : made_) {
    const auto refusal = std::ranges::find(refused, made.sequence, &sim::InputRefusal::sequence);
    end(made.given, refusal != refused.end() ? std::string_view(refusal->text) : "");
  }
  made_.clear();
  return std::exchange(answered_, false);
}

/// One of the inputs of a request is done, or refused.
void InputPost::end(std::uint64_t given, std::string_view refused) {
  const auto found = requests_.find(given);
  if (found == requests_.end()) return;
  Given& request = found->second;
  if (request.refused.empty()) request.refused = refused;
  if (--request.open > 0) return;
  const double at_s = static_cast<double>(step_) * engine_.spec().step.seconds();
  const bool good = request.refused.empty();
  const std::string text =
      good ? fmt::format("{}; counts from step {} on, at {:.3f} s", request.text, step_, at_s)
           : request.refused;
  if (log_ != nullptr && request.told) {
    if (good) log_->info("by hand", "{}", text);
    if (!good) log_->warn("by hand", "refused: {}", text);
  }
  if (request.asked && !request.told) {
    answered_ = true;
    request.asked->answer(good ? Result<std::string>(text)
                               : fail(ErrorCode::kInvalidArgument, "{}", text));
  }
  requests_.erase(found);
}

bool InputPost::put_off(std::string_view why, std::uint64_t step, Clock::time_point now) {
  bool any = false;
  for (auto& [given, request] : requests_) {
    if (!request.asked || request.told || now - request.asked->since() < kAskedPatience) continue;
    request.told = any = true;
    request.asked->answer(fmt::format(
        "requested; the run does not advance now{}{}, so the request is carried out or refused in "
        "step {}; the log of this process has the result",
        why.empty() ? "" : ": ", why, step));
  }
  return any;
}

void InputPost::drop(std::string_view why) {
  for (const Waiting& one : std::exchange(waiting_, {})) end(one.given, why);
}

}  // namespace rave::runtime
