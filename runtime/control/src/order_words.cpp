// SPDX-License-Identifier: Apache-2.0
#include "rave/control/order_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "rave/assemble/parameter_key.hpp"
#include "rave/base/number.hpp"
#include "rave/robot/order.hpp"
#include "rave/sim/orders.hpp"

namespace rave::runtime {
namespace {

using Kind = RunRequest::Kind;

/// Reads the words of a line one after the other.
class Words {
 public:
  explicit Words(std::string_view text) : left_(text) {}
  [[nodiscard]] bool empty() const noexcept { return left_.empty(); }
  std::string_view next() {
    const std::size_t end = std::min(left_.find(' '), left_.size());
    const std::string_view word = left_.substr(0, end);
    left_.remove_prefix(std::min(end + 1, left_.size()));
    return word;
  }
  /// The next word as a number, if it is one.
  std::optional<double> number() {
    const std::string_view before = left_;
    const std::string_view word = next();
    // Reads back exactly what order_words() wrote.
    const auto value = number_of<double>(word);
    // The word stays for the caller: it is the name of the next detail.
    if (!value) left_ = before;
    return value;
  }

 private:
  std::string_view left_;
};

bool read_points(Words& words, RunRequest& request) {
  while (const auto x = words.number()) {
    const auto y = words.number();
    if (!y || request.points.size() >= kMostOrderPoints) return false;
    request.points.push_back({*x, *y});
  }
  return !request.points.empty();
}

bool read_word(Words& words, RunRequest& request) {
  const std::string_view word = words.next();
  if (word == "points") return read_points(words, request);
  const auto number = words.number();
  if (!number) return false;
  if (word == "yaw") {
    request.yaw_rad = *number;
    return true;
  }
  for (const auto& [name, value] : {std::pair<std::string_view, double*>{"v", &request.v_mps},
                                    {"w", &request.w_radps},
                                    {"speed", &request.speed_mps}}) {
    if (name != word) continue;
    *value = *number;
    return true;
  }
  return false;
}

}  // namespace

Status check_path_size(std::size_t points) { return request::check_path_size(points); }

Result<sim::WorldInput::Action> input_action(const RunRequest& request) {
  using Action = sim::WorldInput::Action;
  if (request.kind == Kind::kStop) return Action(request::Stop());
  if (request.kind == Kind::kRelease) return Action(request::Release());
  if (request.kind == Kind::kArm) return Action(request::Arm());
  const auto kind = static_cast<std::uint32_t>(request.kind) -
                    static_cast<std::uint32_t>(Kind::kDrive) +
                    static_cast<std::uint32_t>(OrderKind::kDrive);
  request::OrderParts parts{request.points,  request.yaw_rad,   request.v_mps,
                            request.w_radps, request.speed_mps, request.value};
  RAVE_TRY_ASSIGN(auto order, request::make_order(static_cast<OrderKind>(kind), parts));
  return Action(std::move(order));
}

Result<sim::WorldInput> order_input(const sim::EngineSpec& spec, const RunRequest& request) {
  sim::WorldInput input;
  input.author = {true, request.by};
  if (!request.robot.empty()) {
    RAVE_TRY_ASSIGN(input.robot, find_robot(spec, request.robot));
  } else if (request.kind != Kind::kCancel) {
    return fail(ErrorCode::kInvalidArgument, "`{}` needs a robot", to_string(request.kind));
  }
  RAVE_TRY_ASSIGN(input.action, input_action(request));
  return input;
}

RunRequest input_request(const sim::EngineSpec& spec, const sim::WorldInput& input) {
  RunRequest request;
  if (input.robot.valid()) request.robot = spec.robots[input.robot.value()].name;
  request.by = input.author.name;
  if (input.is<request::Release>()) request.kind = Kind::kRelease;
  if (input.is<request::Arm>()) request.kind = Kind::kArm;
  const auto* const order = input.as<request::Order>();
  if (order == nullptr) return request;
  request.kind = static_cast<Kind>(static_cast<std::size_t>(Kind::kDrive) + order->index());
  const request::OrderParts parts = request::parts_of(*order);
  request.value = parts.text;
  request.points.assign(parts.points_W.begin(), parts.points_W.end());
  request.yaw_rad = parts.yaw_rad;
  request.v_mps = parts.v_mps;
  request.w_radps = parts.w_radps;
  request.speed_mps = parts.speed_mps;
  return request;
}

void write_takes(OrderSet set, std::vector<std::string>& words) {
  OrderSet written = 0;
  constexpr std::array kOrderKinds = {OrderKind::kDrive, OrderKind::kGoal, OrderKind::kPath,
                                      OrderKind::kText, OrderKind::kPlace};
  for (const std::string& word : words) {
    for (const OrderKind kind : kOrderKinds) {
      if (word == to_string(kind)) written |= order_bit(kind);
    }
  }
  // The usual case: nothing has changed, and nothing is allocated.
  if (written == set) return;
  words.clear();
  for (const OrderKind kind : kOrderKinds) {
    if (has_order(set, kind)) words.emplace_back(to_string(kind));
  }
}

std::string order_answer(const RunRequest& request) {
  std::string whom = request.robot.empty() ? "all robots" : request.robot;
  const auto last = [&request] {
    return fmt::format("{:.2f}, {:.2f}", request.points.back().x, request.points.back().y);
  };
  switch (request.kind) {
    case RunRequest::Kind::kDrive:
      return fmt::format("{} is driven", whom);
    case RunRequest::Kind::kGoal:
      return fmt::format("{} is sent to {}", whom, last());
    case RunRequest::Kind::kPath:
      return fmt::format("{} is sent along {} points to {}", whom, request.points.size(), last());
    case RunRequest::Kind::kCancel:
      return fmt::format("{}: the orders of people are cancelled", whom);
    case RunRequest::Kind::kText:
      return fmt::format("the text was sent to {}", whom);
    case RunRequest::Kind::kPlace:
      return fmt::format("{} is placed at {}", whom, last());
    default:
      return whom;
  }
}

std::string order_words(const RunRequest& request) {
  if (request.kind == RunRequest::Kind::kText) return request.value;
  if (request.kind == RunRequest::Kind::kDrive) {
    return fmt::format("v {} w {}", request.v_mps, request.w_radps);
  }
  std::string words;
  const auto add = [&words](std::string_view word) {
    if (!words.empty()) words += ' ';
    words += word;
  };
  if (!request.points.empty()) add("points");
  // `{}` prints the shortest text that reads back as the same number, so that a repeated run gets
  // the same order to the bit.
  for (const Vec2 p_W : request.points) add(fmt::format("{} {}", p_W.x, p_W.y));
  if (request.yaw_rad) add(fmt::format("yaw {}", *request.yaw_rad));
  if (request.speed_mps != 0) add(fmt::format("speed {}", request.speed_mps));
  return words;
}

Status read_order_words(std::string_view text, RunRequest& request) {
  if (request.kind == RunRequest::Kind::kText) {
    request.value = text;
    return {};
  }
  Words words(text);
  while (!words.empty()) {
    if (read_word(words, request)) continue;
    return fail(ErrorCode::kParse, "the details `{}` do not fit an order of kind `{}`", text,
                to_string(request.kind));
  }
  return {};
}

}  // namespace rave::runtime
