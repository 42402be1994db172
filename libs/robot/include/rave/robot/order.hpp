// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"

// Orders: what user interfaces ask of a robot during a run. A program receives the kinds that its
// constant `static constexpr OrderSet kTakes` lists, together with its percepts.
namespace rave {
/// The kind of an order.
enum class OrderKind : std::uint32_t {
  kNone = 0,
  kDrive = 1,   ///< A velocity. It bypasses the program; see Percepts::is_driven().
  kGoal = 2,    ///< A point to drive to.
  kPath = 3,    ///< A path to follow.
  kCancel = 4,  ///< Cancels the previous goal or path.
  kText = 5,    ///< A text.
  kPlace = 6,   ///< A new pose for the robot. Not passed to programs.
};

/// `drive`, `goal`, `path`, `cancel`, `text` or `place`.
[[nodiscard]] std::string_view to_string(OrderKind kind) noexcept;
/// @{ A set of kinds of orders, one bit each: `kTakesGoal | kTakesText`. has_order() tests a bit.
using OrderSet = std::uint32_t;
[[nodiscard]] constexpr OrderSet order_bit(OrderKind kind) noexcept {
  return OrderSet{1} << static_cast<std::uint32_t>(kind);
}
[[nodiscard]] constexpr bool has_order(OrderSet set, OrderKind kind) noexcept {
  return (set & order_bit(kind)) != 0;
}
inline constexpr OrderSet kTakesGoal = order_bit(OrderKind::kGoal);
inline constexpr OrderSet kTakesPath = order_bit(OrderKind::kPath);
inline constexpr OrderSet kTakesText = order_bit(OrderKind::kText);
/// @}
inline constexpr std::size_t kMostOrderPoints = 1000;  ///< Of a path.
inline constexpr std::size_t kMostOrderText = 1000;  ///< Bytes of UTF-8, for kText and for answers.
inline constexpr std::size_t kMostOrderAuthor = 64;  ///< Bytes of the sender's name.
/// The number of orders that can wait for one decision. Of goal, path and cancel only the last is
/// kept.
inline constexpr std::size_t kMostWaitingOrders = 8;

/// One order in the plug-in interface. Programs use Order.
struct OrderItem {
  OrderKind kind = OrderKind::kNone;
  std::uint32_t point_count = 0;
  const Vec2* points = nullptr;  ///< World frame, m.
  double yaw_rad = 0;
  double speed_mps = 0;
  const char* text = nullptr;
  const char* by = nullptr;
  std::uint32_t text_size = 0;
  std::uint32_t by_size = 0;
  std::uint32_t has_yaw = 0;
  std::uint32_t reserved = 0;
};

/// One order for a program. A view: valid during decide().
struct Order {
  OrderKind kind = OrderKind::kNone;
  /// kGoal: one point. kPath: 2 to kMostOrderPoints. World frame, m.
  std::span<const Vec2> points_W;
  std::optional<double> yaw_rad;  ///< kGoal: heading at the goal, world frame; empty: any.
  double speed_mps = 0;           ///< kGoal, kPath: speed limit; 0: the program decides.
  std::string_view text;          ///< kText.
  std::string_view by;            ///< User name of the sender; empty: the terminal of the host.
};

/// Iterates over the orders of a decision.
class OrderIterator {
 public:
  explicit OrderIterator(const OrderItem* item) noexcept : item_(item) {}
  [[nodiscard]] Order operator*() const noexcept {
    Order order;
    order.kind = item_->kind;
    order.points_W = {item_->points, item_->point_count};
    if (item_->has_yaw != 0) order.yaw_rad = item_->yaw_rad;
    order.speed_mps = item_->speed_mps;
    order.text = {item_->text, item_->text_size};
    order.by = {item_->by, item_->by_size};
    return order;
  }
  OrderIterator& operator++() noexcept {
    ++item_;
    return *this;
  }
  [[nodiscard]] bool operator!=(const OrderIterator& other) const noexcept {
    return item_ != other.item_;
  }

 private:
  const OrderItem* item_;
};

/// The orders since the last decision: `for (const Order order : percepts.orders())`.
class Orders {
 public:
  Orders(const OrderItem* items, std::uint32_t count) noexcept : items_(items), count_(count) {}
  [[nodiscard]] std::size_t size() const noexcept { return count_; }
  [[nodiscard]] bool empty() const noexcept { return count_ == 0; }
  [[nodiscard]] OrderIterator begin() const noexcept { return OrderIterator(items_); }
  [[nodiscard]] OrderIterator end() const noexcept { return OrderIterator(items_ + count_); }

 private:
  const OrderItem* items_;
  std::uint32_t count_;
};

/// Accepts answers of programs to users. Call it only from the thread of a decision; several robots
/// may decide at once.
struct AnswerService {
  void* context = nullptr;
  /// Sends an answer. `done` is not 0 if it completes the current order. False: the text is too
  /// long, or the robot has sent too much in this decision; nothing is sent.
  bool (*say)(void* context, std::uint32_t robot, const char* text, std::uint64_t size,
              std::uint32_t done) = nullptr;
};

}  // namespace rave
