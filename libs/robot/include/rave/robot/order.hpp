// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"

// What people ask of a robot while it runs. A program that says what it takes, by a constant
// `static constexpr OrderSet kTakes`, gets it with its percepts.
namespace rave {
/// What an order asks of a robot.
enum class OrderKind : std::uint32_t {
  kNone = 0,
  kDrive = 1,   ///< A velocity. Never reaches a program, which is told by Percepts::is_driven().
  kGoal = 2,    ///< A point to go to.
  kPath = 3,    ///< A line to follow.
  kCancel = 4,  ///< What was asked before counts no more.
  kText = 5,    ///< Words.
  kPlace = 6,   ///< The robot is put elsewhere. Never reaches a program.
};

/// `drive`, `goal`, `path`, `cancel`, `text` or `place`.
[[nodiscard]] std::string_view to_string(OrderKind kind) noexcept;
/// @{
/// A set of kinds of orders, one bit each: `kTakesGoal | kTakesText`; has_order() asks for a bit.
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
inline constexpr std::size_t kMostOrderText = 1000;    ///< Bytes of UTF-8, of kText and of answers.
inline constexpr std::size_t kMostOrderAuthor = 64;    ///< Bytes of the name of who asks.
/// Orders that wait for one decision; of goal, path and cancel only the last one counts.
inline constexpr std::size_t kMostWaitingOrders = 8;

/// One order as it crosses the interface. Programs use Order.
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

/// One order as a program sees it. A view: valid during decide().
struct Order {
  OrderKind kind = OrderKind::kNone;
  std::span<const Vec2> points_W;  ///< kGoal: one. kPath: 2 to kMostOrderPoints. World frame, m.
  std::optional<double> yaw_rad;   ///< kGoal: which way to look there; none: as it comes.
  double speed_mps = 0;            ///< kGoal, kPath: the largest; 0: as the robot likes.
  std::string_view text;           ///< kText.
  std::string_view by;             ///< Who asks; empty: the terminal of the machine.
};

/// Goes through the orders of a decision.
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

/// The orders that came since the last decision: `for (const Order order : percepts.orders())`.
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

/// How a program answers people. Called from the thread of its decision alone; several robots
/// decide at a time.
struct AnswerService {
  void* context = nullptr;
  /// Takes an answer; `done` is not 0 if the order under way is done with it. False: it is too
  /// long, or the robot has said too much in this decision; then nothing of it is taken.
  bool (*say)(void* context, std::uint32_t robot, const char* text, std::uint64_t size,
              std::uint32_t done) = nullptr;
};

}  // namespace rave
