// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "rave/base/result.hpp"
#include "rave/request/chat.hpp"
#include "rave/request/edit.hpp"
#include "rave/request/order.hpp"
#include "rave/request/robot_action.hpp"

namespace rave::request {

using Action = std::variant<Stop, Release, Arm, Set, Edit, ListObstacles, HandOver, ResetShadow,
                            Drive, Goal, Path, Cancel, Text, Place, Take, Give, Chat>;

/// Something that is asked of a run, with whom it concerns and who asks. A value, the same
/// whichever way it comes: page, direct line, control socket, bus, recording, scenario, script.
struct Request {
  Action action = Stop{};
  std::string robot{};  ///< Empty: all robots, where the action permits that.
  /// Name of the person, at most kMostOrderAuthor bytes. Empty: the local terminal, a super-user.
  std::string by{};
  /// The person is a super-user, who needs no lease for a release and may take over a lease.
  bool overrides = false;
  std::uint64_t page = 0;  ///< Id of the person's page; 0: none, such as a script.

  /// The action if it is this one; nullptr for any other.
  template <class One>
  [[nodiscard]] const One* as() const noexcept {
    return std::get_if<One>(&action);
  }
  /// Whether the action is one of these.
  template <class... One>
  [[nodiscard]] bool is() const noexcept {
    return (std::holds_alternative<One>(action) || ...);
  }
  friend bool operator==(const Request&, const Request&) = default;
};

/// The name of what is asked: `stop`, `goal`, …
[[nodiscard]] std::string_view name_of(const Action& action) noexcept;
/// All names, in the order of the variant.
[[nodiscard]] std::span<const std::string_view> action_names() noexcept;

// Traits of actions; each is said here once, for all ways that a request can come.

/// An order: it needs a robot and its lease, and is an input of the run.
[[nodiscard]] bool is_order(const Action& action) noexcept;
/// A stop, a release or an arming: what holds a robot.
[[nodiscard]] bool is_hold(const Action& action) noexcept;
/// About the lease of a robot, which its host owns.
[[nodiscard]] bool is_of_lease(const Action& action) noexcept;
/// Changes nothing in the run: answered at once, and not recorded as an input.
[[nodiscard]] bool only_reads(const Action& action) noexcept;
/// Concerns one robot; the others concern all robots if none is named, or no robot.
[[nodiscard]] bool needs_robot(const Action& action) noexcept;

/// May not name a robot: of the world, or of people.
[[nodiscard]] bool is_of_no_robot(const Action& action) noexcept;

/// An order as an action, and back.
[[nodiscard]] Action action_of(Order order);
[[nodiscard]] std::optional<Order> order_of(const Action& action);

/// The request as JSON in one line: `{"do": "goal", "robot": "r1", "point": [1, 2], "by": "anna"}`.
/// Members that say nothing are left out.
[[nodiscard]] std::string to_json_line(const Request& request);
/// The inverse; strict. Error kParse, with the key and what was expected of it.
[[nodiscard]] Result<Request> from_json(std::string_view line);
/// The same from and to a tree, for requests that are parts of other messages.
[[nodiscard]] codec::RawNode to_node(const Request& request);
[[nodiscard]] Result<Request> from_node(const codec::RawNode& node);
/// Who asks, for requests with other actions that have the same keys for it: appends them, and
/// moves them out of a tree. Error kParse.
void append_sender(const Request& sender, codec::RawNode& node);
[[nodiscard]] Result<Request> take_sender(codec::RawNode& node);

}  // namespace rave::request
