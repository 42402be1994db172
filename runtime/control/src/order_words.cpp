// SPDX-License-Identifier: Apache-2.0
#include "rave/control/order_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "rave/assemble/input_action.hpp"
#include "rave/assemble/parameter_key.hpp"
#include "rave/base/number.hpp"
#include "rave/control/obstacle_edits.hpp"
#include "rave/robot/order.hpp"

namespace rave::runtime {
namespace {

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

/// What the words of an order are.
struct ReadParts {
  std::vector<Vec2> points;
  request::OrderParts parts;
};

bool read_points(Words& words, std::vector<Vec2>& points) {
  while (const auto x = words.number()) {
    const auto y = words.number();
    if (!y || points.size() >= kMostOrderPoints) return false;
    points.push_back({*x, *y});
  }
  return !points.empty();
}

bool read_pedals(Words& words, request::Pedals& pedals) {
  for (double* const value : {&pedals.steering, &pedals.throttle, &pedals.brake, &pedals.gear}) {
    const auto number = words.number();
    if (!number) return false;
    *value = *number;
  }
  return pedals.is_valid();
}

bool read_word(Words& words, ReadParts& read) {
  const std::string_view word = words.next();
  if (word == "pedals") return read_pedals(words, read.parts.pedals.emplace());
  if (word == "points") return read_points(words, read.points);
  const auto number = words.number();
  if (!number) return false;
  if (word == "yaw") {
    read.parts.yaw_rad = *number;
    return true;
  }
  for (const auto& [name, value] : {std::pair<std::string_view, double*>{"v", &read.parts.v_mps},
                                    {"w", &read.parts.w_radps},
                                    {"vy", &read.parts.vy_mps},
                                    {"speed", &read.parts.speed_mps}}) {
    if (name != word) continue;
    *value = *number;
    return true;
  }
  return false;
}

std::string order_words(const request::Order& order) {
  const request::OrderParts parts = request::parts_of(order);
  if (const auto* const text = std::get_if<request::Text>(&order)) return text->text;
  if (std::holds_alternative<request::Drive>(order)) {
    std::string drive = fmt::format("v {} w {}", parts.v_mps, parts.w_radps);
    if (parts.vy_mps != 0) drive += fmt::format(" vy {}", parts.vy_mps);
    if (const auto& pedals = parts.pedals) {
      drive += fmt::format(" pedals {} {} {} {}", pedals->steering, pedals->throttle, pedals->brake,
                           pedals->gear);
    }
    return drive;
  }
  std::string words;
  const auto add = [&words](std::string_view word) {
    if (!words.empty()) words += ' ';
    words += word;
  };
  if (!parts.points_W.empty()) add("points");
  // `{}` prints the shortest text that reads back as the same number, so that a repeated run gets
  // the same order to the bit.
  for (const Vec2 p_W : parts.points_W) add(fmt::format("{} {}", p_W.x, p_W.y));
  if (parts.yaw_rad) add(fmt::format("yaw {}", *parts.yaw_rad));
  if (parts.speed_mps != 0) add(fmt::format("speed {}", parts.speed_mps));
  return words;
}

Result<request::Action> read_order(OrderKind kind, const std::string& text) {
  ReadParts read;
  if (kind == OrderKind::kText) {
    read.parts.text = text;
  } else {
    Words words(text);
    while (!words.empty()) {
      if (read_word(words, read)) continue;
      return fail(ErrorCode::kParse, "the details `{}` do not fit an order of kind `{}`", text,
                  to_string(kind));
    }
  }
  read.parts.points_W = read.points;
  auto order = request::make_order(kind, read.parts);
  if (order) return request::action_of(*std::move(order));
  return fail(ErrorCode::kParse, "the details `{}` do not fit an order of kind `{}`: {}", text,
              to_string(kind), order.error().message);
}

/// Writes what an action that is no order has.
struct WriteWords {
  RecordedWords& words;
  void operator()(const request::Set& set) const {
    words.key = set.key;
    words.value = set.value;
  }
  void operator()(const request::HandOver& hand_over) const { words.value = hand_over.to; }
  void operator()(const request::Edit& edit) const { words.value = config::write_edit(edit.edit); }
  /// The others say nothing more, or are no inputs of the run.
  template <class One>
  void operator()(const One& /*one*/) const {}
};

}  // namespace

Result<sim::WorldInput> input_for(const sim::EngineSpec& spec, const request::Request& request) {
  sim::WorldInput input;
  input.author = {true, request.by};
  if (!request.robot.empty()) {
    RAVE_TRY_ASSIGN(input.robot, find_robot(spec, request.robot));
  } else if (request::needs_robot(request.action)) {
    return fail(ErrorCode::kInvalidArgument, "`{}` needs a robot",
                request::name_of(request.action));
  }
  auto action = input_action(request.action);
  if (!action) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not an order",
                request::name_of(request.action));
  }
  input.action = *std::move(action);
  return input;
}

request::Request input_request(const sim::EngineSpec& spec, const sim::WorldInput& input) {
  request::Request request;
  if (input.robot.valid()) request.robot = spec.robots[input.robot.value()].name;
  request.by = input.author.name;
  if (input.is<request::Release>()) request.action = request::Release();
  if (input.is<request::Arm>()) request.action = request::Arm();
  if (const auto* const order = input.as<request::Order>()) {
    request.action = request::action_of(*order);
  }
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

std::string order_answer(const request::Request& request) {
  const std::string whom = request.robot.empty() ? "all robots" : request.robot;
  const auto at = [](Vec2 p_W) { return fmt::format("{:.2f}, {:.2f}", p_W.x, p_W.y); };
  if (request.is<request::Drive>()) return fmt::format("{} is driven", whom);
  if (const auto* const goal = request.as<request::Goal>()) {
    return fmt::format("{} is sent to {}", whom, at(goal->p_W));
  }
  if (const auto* const path = request.as<request::Path>()) {
    return fmt::format("{} is sent along {} points to {}", whom, path->points_W.size(),
                       at(path->points_W.back()));
  }
  if (request.is<request::Cancel>()) {
    return fmt::format("{}: the orders of people are cancelled", whom);
  }
  if (request.is<request::Text>()) return fmt::format("the text was sent to {}", whom);
  if (const auto* const place = request.as<request::Place>()) {
    return fmt::format("{} is placed at {}", whom, at(place->p_W));
  }
  return whom;
}

RecordedWords recorded_words(const request::Action& action) {
  RecordedWords words{std::string(request::name_of(action)), {}, {}};
  if (const auto order = request::order_of(action)) {
    words.value = order_words(*order);
  } else {
    std::visit(WriteWords{words}, action);
  }
  return words;
}

Result<request::Action> recorded_action(const RecordedWords& words) {
  if (auto edit = recorded_edit(words.kind, words.key, words.value)) {
    RAVE_TRY_ASSIGN(auto read, *std::move(edit));
    return request::Edit{std::move(read)};
  }
  if (const auto order = request::order_named(words.kind)) return read_order(*order, words.value);
  for (request::Action plain :
       {request::Action(request::Stop()), request::Action(request::Release()),
        request::Action(request::Arm()), request::Action(request::ResetShadow())}) {
    if (request::name_of(plain) == words.kind) return plain;
  }
  if (words.kind == request::Set::kName) return request::Set{words.key, words.value};
  if (words.kind == request::HandOver::kName) return request::HandOver{words.value};
  return fail(ErrorCode::kParse,
              "the recording has an input `{}`, which this version of RAVE does not know",
              words.kind);
}

}  // namespace rave::runtime
