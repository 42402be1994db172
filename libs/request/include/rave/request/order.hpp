// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/math/pose.hpp"
#include "rave/request/pedals.hpp"
#include "rave/robot/order.hpp"

// Orders: what a robot is asked to do. Each needs a robot, and a person needs its lease. Points are
// in the world frame, m; headings are rad, counter-clockwise from x.
namespace rave::request {

/// A velocity instead of the program's commands to velocity controllers. It ends by itself if it is
/// not repeated; only the newest counts, and it is not answered.
struct Drive {
  static constexpr std::string_view kName = "drive";
  double v_mps = 0;    ///< Forward.
  double w_radps = 0;  ///< Counter-clockwise.
  double vy_mps = 0;   ///< To the left; robots that do not move sideways ignore it.
  /// For a robot with a controller of pedals, which then ignores the velocity.
  std::optional<Pedals> pedals{};
  [[nodiscard]] bool stands() const noexcept {
    const bool still = !pedals || (pedals->throttle == 0 && pedals->steering == 0);
    return v_mps == 0 && w_radps == 0 && vy_mps == 0 && still;
  }
  friend bool operator==(const Drive&, const Drive&) = default;
};

/// A point to drive to.
struct Goal {
  static constexpr std::string_view kName = "goal";
  Vec2 p_W{};
  std::optional<double> yaw_rad{};  ///< Heading there; empty: any.
  double speed_mps = 0;             ///< The largest; 0: the robot decides.
  friend bool operator==(const Goal&, const Goal&) = default;
};

/// A path to follow: 2 to kMostOrderPoints points.
struct Path {
  static constexpr std::string_view kName = "path";
  std::vector<Vec2> points_W{};
  double speed_mps = 0;  ///< The largest; 0: the robot decides.
  friend bool operator==(const Path&, const Path&) = default;
};

/// Ends the present order. Without a robot: of all robots.
struct Cancel {
  static constexpr std::string_view kName = "cancel";
  friend bool operator==(const Cancel&, const Cancel&) = default;
};

/// A text for the program: 1 to kMostOrderText bytes of UTF-8.
struct Text {
  static constexpr std::string_view kName = "text";
  std::string text{};
  friend bool operator==(const Text&, const Text&) = default;
};

/// Places a simulated robot elsewhere.
struct Place {
  static constexpr std::string_view kName = "place";
  Vec2 p_W{};
  std::optional<double> yaw_rad{};  ///< Empty: as before.
  friend bool operator==(const Place&, const Place&) = default;
};

using Order = std::variant<Drive, Goal, Path, Cancel, Text, Place>;

/// The kind that programs know. The plug-in interface numbers them in the order of the variant.
[[nodiscard]] constexpr OrderKind order_kind(const Order& order) noexcept {
  return static_cast<OrderKind>(order.index() + 1);
}
static_assert(static_cast<std::size_t>(OrderKind::kPlace) == std::variant_size_v<Order>);
static_assert(order_kind(Drive{}) == OrderKind::kDrive && order_kind(Goal{}) == OrderKind::kGoal &&
              order_kind(Cancel{}) == OrderKind::kCancel &&
              order_kind(Place{}) == OrderKind::kPlace);

/// The kind of this name; empty: no order has it.
[[nodiscard]] std::optional<OrderKind> order_named(std::string_view name) noexcept;

template <class One>
concept IsOrder = !std::same_as<One, Order> && std::constructible_from<Order, One>;

/// What orders consist of, each kind of some of it: for those that treat all kinds alike, such as
/// the run hash, programs and the bus. A view.
struct OrderParts {
  std::span<const Vec2> points_W{};
  std::optional<double> yaw_rad{};
  double v_mps = 0;
  double w_radps = 0;
  double speed_mps = 0;
  std::string_view text{};
  double vy_mps = 0;
  std::optional<Pedals> pedals{};
};
/// Valid as long as the order; nothing for nullptr.
[[nodiscard]] OrderParts parts_of(const Order& order) noexcept;
[[nodiscard]] OrderParts parts_of(const Order* order) noexcept;
/// The inverse; parts that an order of this kind does not have are ignored. Error kInvalidArgument:
/// there is no such kind, or it needs one point.
[[nodiscard]] Result<Order> make_order(OrderKind kind, const OrderParts& parts);

/// Whether the number of points makes a path. Error kInvalidArgument with what was expected.
[[nodiscard]] Status check_path_size(std::size_t points);

}  // namespace rave::request
