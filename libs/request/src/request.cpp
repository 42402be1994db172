// SPDX-License-Identifier: Apache-2.0
#include "rave/request/request.hpp"

#include <utility>

#include "fields.hpp"

namespace rave::request {
namespace {

template <class... One>
bool is_any_of(const Action& action) noexcept {
  return (std::holds_alternative<One>(action) || ...);
}

/// Moves what is not left at its default from one tree to another.
void append_said(const codec::RawNode& from, const codec::RawNode& defaults, codec::RawNode& to) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const codec::RawNode* const usual = defaults.find(from.key(i));
    if (usual == nullptr || !(*usual == from.child(i))) to.append(from.key(i), from.child(i));
  }
}

/// The tree of the same action with nothing said.
codec::RawNode defaults_of(const Action& action) {
  return std::visit([]<class One>(const One&) { return codec::Codec<One>::write(One{}); }, action);
}

/// The keys that every action writes, since they are required.
bool is_required(std::string_view key) {
  return key == "v" || key == "w" || key == "point" || key == "points" || key == "text";
}

}  // namespace

std::string_view name_of(const Action& action) noexcept { return codec::name_of(action); }
std::span<const std::string_view> action_names() noexcept { return codec::Codec<Action>::kNames; }

bool is_order(const Action& action) noexcept {
  return is_any_of<Drive, Goal, Path, Cancel, Text, Place>(action);
}
bool is_hold(const Action& action) noexcept { return is_any_of<Stop, Release, Arm>(action); }
bool is_of_lease(const Action& action) noexcept { return is_any_of<Take, Give>(action); }
bool only_reads(const Action& action) noexcept { return is_any_of<ListObstacles>(action); }
bool is_of_no_robot(const Action& action) noexcept {
  return is_any_of<Edit, ListObstacles, Chat>(action);
}
bool needs_robot(const Action& action) noexcept {
  return is_any_of<Set, HandOver, Drive, Goal, Path, Text, Place, Take, Give>(action);
}

Action action_of(Order order) {
  return std::visit([](auto&& one) { return Action(std::forward<decltype(one)>(one)); },
                    std::move(order));
}

std::optional<Order> order_of(const Action& action) {
  return std::visit(
      []<class One>(const One& one) -> std::optional<Order> {
        if constexpr (std::is_constructible_v<Order, One>) {
          return Order(one);
        } else {
          return std::nullopt;
        }
      },
      action);
}

void append_sender(const Request& sender, codec::RawNode& node) {
  const Sender said{sender.robot, sender.by, sender.overrides, sender.page};
  append_said(codec::write_node(said), codec::write_node(Sender{}), node);
}

Result<Request> take_sender(codec::RawNode& node) {
  codec::RawNode of_sender = codec::RawNode::mapping();
  for (const char* const key : {"robot", "by", "overrides", "page"}) {
    const codec::RawNode* const value = node.find(key);
    if (value == nullptr) continue;
    of_sender.append(key, *value);
    node.erase(key);
  }
  RAVE_TRY_ASSIGN(auto sender, codec::read_node<Sender>(of_sender));
  Request request;
  request.robot = std::move(sender.robot);
  request.by = std::move(sender.by);
  request.overrides = sender.overrides;
  request.page = sender.page;
  return request;
}

codec::RawNode to_node(const Request& request) {
  codec::RawNode node = codec::RawNode::mapping(
      {{codec::kVariantKey, codec::RawNode::text(std::string(name_of(request.action)))}});
  append_sender(request, node);
  const codec::RawNode action = codec::write_node(request.action);
  codec::RawNode defaults = defaults_of(request.action);
  for (const std::string_view key : action.keys()) {
    if (is_required(key)) defaults.erase(key);
  }
  defaults.set(codec::kVariantKey, *action.find(codec::kVariantKey));
  append_said(action, defaults, node);
  return node;
}

Result<Request> from_node(const codec::RawNode& node) {
  if (!node.is_mapping()) return fail(ErrorCode::kParse, "expected an object");
  codec::RawNode rest = node;
  RAVE_TRY_ASSIGN(Request request, take_sender(rest));
  RAVE_TRY_ASSIGN(request.action, codec::read_node<Action>(rest));
  const std::string_view name = name_of(request.action);
  if (request.robot.empty() && needs_robot(request.action)) {
    return fail(ErrorCode::kParse, "`{}` needs a robot", name);
  }
  if (!request.robot.empty() && is_of_no_robot(request.action)) {
    return fail(ErrorCode::kParse, "`{}` concerns no robot: unexpected key `robot`", name);
  }
  const bool has_author = !request.by.empty() || request.overrides || request.page != 0;
  if (only_reads(request.action) && has_author) {
    return fail(ErrorCode::kParse, "`{}` changes nothing: unexpected author", name);
  }
  if (request.is<Chat>() && request.by.empty()) {
    return fail(ErrorCode::kParse, "`{}` needs its author: expected the key `by`", name);
  }
  return request;
}

std::string to_json_line(const Request& request) { return codec::to_json_line(to_node(request)); }

Result<Request> from_json(std::string_view line) {
  RAVE_TRY_ASSIGN(const codec::RawNode node, codec::parse_json(line));
  return from_node(node);
}

}  // namespace rave::request
