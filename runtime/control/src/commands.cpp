// SPDX-License-Identifier: Apache-2.0
#include "rave/control/commands.hpp"

#include <chrono>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/base/text_width.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/control/host_leases.hpp"
#include "rave/robot/order.hpp"

namespace rave::control {
namespace {

using runtime::RunControl;

/// The kind on the wire: orders come first, in the order of their variant, then what holds robots.
static_assert(std::variant_size_v<request::Order> == rave_wire_COMMAND_STOP);

std::optional<rave_wire_CommandKind> wire_kind(const request::Request& request) {
  if (const auto order = request::order_of(request.action)) {
    return static_cast<rave_wire_CommandKind>(order->index());
  }
  if (request.is<request::Stop>()) return rave_wire_COMMAND_STOP;
  if (request.is<request::Release>()) return rave_wire_COMMAND_RELEASE;
  if (request.is<request::Arm>()) return rave_wire_COMMAND_ARM;
  return std::nullopt;
}

Result<request::Action> action_of(const bus::Command& command) {
  if (command.kind == rave_wire_COMMAND_STOP) return request::Stop();
  if (command.kind == rave_wire_COMMAND_RELEASE) return request::Release();
  if (command.kind == rave_wire_COMMAND_ARM) return request::Arm();
  std::vector<Vec2> points_W;
  for (const auto& point : bus::elements(command.points)) {
    points_W.push_back({point.x_m, point.y_m});
  }
  request::OrderParts parts{points_W,          {},          command.v_mps, command.w_radps,
                            command.speed_mps, command.text};
  if (command.has_yaw) parts.yaw_rad = command.yaw_rad;
  parts.vy_mps = command.vy_mps;
  parts.pedals = request::pedals_of(command.pedals);
  const auto kind = static_cast<OrderKind>(command.kind + 1);
  if (kind == OrderKind::kPath) RAVE_TRY(request::check_path_size(points_W.size()));
  RAVE_TRY_ASSIGN(auto order, request::make_order(kind, parts));
  return request::action_of(std::move(order));
}

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
  auto order = request_of(command, robot);
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

Status to_command(const request::Request& request, bus::Command& command,
                  std::vector<rave_wire_OrderPoint>& points) {
  const auto kind = wire_kind(request);
  if (!kind) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not an order",
                request::name_of(request.action));
  }
  const auto order = request::order_of(request.action);
  const auto parts = request::parts_of(order ? &*order : nullptr);
  if (request.is<request::Path>()) RAVE_TRY(request::check_path_size(parts.points_W.size()));
  command = {};
  command.kind = *kind;
  command.page = request.page;
  // An order needs the lease, even that of a super-user.
  command.overrides = request.overrides && !order;
  if (request.by.empty() || !bus::put_text(command.author, request.by)) {
    return fail(ErrorCode::kInvalidArgument, "the author `{}`: expected 1 to {} bytes", request.by,
                sizeof command.author - 1);
  }
  if (!bus::put_text(command.text, std::string(parts.text))) {
    return fail(ErrorCode::kInvalidArgument, "the text has {} bytes; expected at most {}",
                parts.text.size(), sizeof command.text - 1);
  }
  points.clear();
  for (const Vec2 p_W : parts.points_W) points.push_back({p_W.x, p_W.y});
  bus::borrow(command.points, points);
  command.has_yaw = parts.yaw_rad.has_value();
  command.yaw_rad = parts.yaw_rad.value_or(0);
  command.v_mps = parts.v_mps;
  command.w_radps = parts.w_radps;
  command.vy_mps = parts.vy_mps;
  request::put_pedals(parts.pedals, command.pedals);
  command.speed_mps = parts.speed_mps;
  return {};
}

Result<request::Request> request_of(const bus::Command& command, std::string robot) {
  // This name stands for the terminal on the run's own machine, so commands from the bus may not
  // use it.
  if (command.author == std::string_view(runtime::HostLeases::kTerminal)) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not a valid name of a person",
                command.author);
  }
  RAVE_TRY_ASSIGN(auto action, action_of(command));
  return request::Request{std::move(action), std::move(robot), command.author, command.overrides,
                          command.page};
}

}  // namespace rave::control
