// SPDX-License-Identifier: Apache-2.0
#include "rave/control/commands.hpp"

#include <array>
#include <chrono>
#include <future>
#include <map>
#include <memory>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/base/text_width.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/control/host_leases.hpp"
#include "rave/control/order_words.hpp"
#include "rave/robot/order.hpp"

namespace rave::control {
namespace {

using runtime::RunControl;
using runtime::RunRequest;
using Kind = RunRequest::Kind;

/// In the order of rave_wire_CommandKind.
constexpr std::array kKinds = {Kind::kDrive,  Kind::kGoal,    Kind::kPath,
                               Kind::kCancel, Kind::kText,    Kind::kPlace,
                               Kind::kStop,   Kind::kRelease, Kind::kArm};
static_assert(kKinds.size() == rave_wire_COMMAND_ARM + 1);

bus::CommandResult result_of(const Result<std::string>& result) {
  std::string text = without_control_characters(result ? *result : result.error().message, " ");
  if (text.size() > rave_wire_kMaxCommandAnswerBytes) {
    text.resize(rave_wire_kMaxCommandAnswerBytes);
    // A character that was cut in two would make the answer invalid, and it would not arrive at
    // all.
    for (int cut = 0; cut < 3 && !is_utf8(text); ++cut) text.pop_back();
  }
  return {result.has_value(), std::move(text)};
}

bus::BegunCommand refused(Error error) {
  return [result = result_of(tl::unexpected(std::move(error)))] { return std::optional(result); };
}

bus::BegunCommand begin(RunControl& control, const bus::Command& command,
                        const std::string& robot) {
  auto order = order_of(command, robot);
  // A drive gets no answer: its driver sees what the robot does, and renews it many times a second.
  const bool drive = command.kind == rave_wire_COMMAND_DRIVE;
  if (!order) return drive ? bus::BegunCommand() : refused(std::move(order).error());
  auto posted = control.post(*std::move(order));
  if (drive) return {};
  if (!posted) return refused(std::move(posted).error());
  // shared_ptr because a std::function must be copyable, and it is shared with nothing else.
  const auto awaited = std::make_shared<std::future<Result<std::string>>>(*std::move(posted));
  return [awaited]() -> std::optional<bus::CommandResult> {
    if (awaited->wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      return std::nullopt;
    }
    return result_of(awaited->get());
  };
}

}  // namespace

Result<bus::BeginCommand> commands_of(RunControl& control, const config::ExpandedScenario& scenario,
                                      std::string_view host) {
  std::map<std::uint32_t, std::string> robots;
  RAVE_TRY_ASSIGN(const auto hosts, config::plan_hosts(scenario));
  for (const config::PlannedHost& planned : hosts) {
    if (planned.name != host) continue;
    for (const std::size_t r : planned.robots) {
      robots.emplace(static_cast<std::uint32_t>(r), scenario.robots[r].name);
    }
  }
  if (host.empty()) {
    for (std::uint32_t r = 0; r < scenario.robots.size(); ++r) {
      robots.emplace(r, scenario.robots[r].name);
    }
  }
  return [&control, robots = std::move(robots)](const bus::Command& command) -> bus::BegunCommand {
    const auto robot = robots.find(command.robot);
    if (robot == robots.end()) return {};
    return begin(control, command, robot->second);
  };
}

Status to_command(const RunRequest& order, bus::Command& command,
                  std::vector<rave_wire_OrderPoint>& points) {
  const auto* const kind = std::ranges::find(kKinds, order.kind);
  if (kind == kKinds.end()) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not an order", to_string(order.kind));
  }
  if (order.kind == Kind::kPath) RAVE_TRY(runtime::check_path_size(order.points.size()));
  command = {};
  command.kind = static_cast<rave_wire_CommandKind>(kind - kKinds.begin());
  command.page = order.page;
  // An order needs the lease, even that of a super-user.
  command.overrides = order.overrides && !runtime::is_order(order.kind);
  if (order.by.empty() || !bus::put_text(command.author, order.by)) {
    return fail(ErrorCode::kInvalidArgument, "the author `{}`: expected 1 to {} bytes", order.by,
                sizeof command.author - 1);
  }
  if (!bus::put_text(command.text, order.value)) {
    return fail(ErrorCode::kInvalidArgument, "the text has {} bytes; expected at most {}",
                order.value.size(), sizeof command.text - 1);
  }
  points.clear();
  for (const Vec2 p_W : order.points) points.push_back({p_W.x, p_W.y});
  bus::borrow(command.points, points);
  command.has_yaw = order.yaw_rad.has_value();
  command.yaw_rad = order.yaw_rad.value_or(0);
  command.v_mps = order.v_mps;
  command.w_radps = order.w_radps;
  command.speed_mps = order.speed_mps;
  return {};
}

Result<RunRequest> order_of(const bus::Command& command, std::string robot) {
  RunRequest order;
  order.kind = kKinds[command.kind];
  order.robot = std::move(robot);
  order.by = command.author;
  // This name stands for the terminal on the run's own machine, so commands from the bus may not
  // use it.
  if (order.by == runtime::HostLeases::kTerminal) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not a valid name of a person", order.by);
  }
  if (order.kind == Kind::kPath) RAVE_TRY(runtime::check_path_size(command.points._length));
  for (const auto& point : bus::elements(command.points)) {
    order.points.push_back({point.x_m, point.y_m});
  }
  if (command.has_yaw) order.yaw_rad = command.yaw_rad;
  order.value = command.text;
  order.v_mps = command.v_mps;
  order.w_radps = command.w_radps;
  order.speed_mps = command.speed_mps;
  order.page = command.page;
  order.overrides = command.overrides;
  return order;
}

}  // namespace rave::control
