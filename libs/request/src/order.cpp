// SPDX-License-Identifier: Apache-2.0
#include "rave/request/order.hpp"

#include <array>
#include <utility>

namespace rave::request {
namespace {

/// A new kind of order that consists of these parts needs nothing here.
template <class One>
Result<Order> make(const OrderParts& parts) {
  One one;
  if constexpr (requires { one.p_W; }) {
    if (parts.points_W.size() != 1) {
      return fail(ErrorCode::kInvalidArgument, "{} points; expected one", parts.points_W.size());
    }
    one.p_W = parts.points_W.front();
  }
  if constexpr (requires { one.points_W; }) {
    one.points_W.assign(parts.points_W.begin(), parts.points_W.end());
  }
  if constexpr (requires { one.yaw_rad; }) one.yaw_rad = parts.yaw_rad;
  if constexpr (requires { one.v_mps; }) one.v_mps = parts.v_mps;
  if constexpr (requires { one.w_radps; }) one.w_radps = parts.w_radps;
  if constexpr (requires { one.vy_mps; }) one.vy_mps = parts.vy_mps;
  if constexpr (requires { one.pedals; }) one.pedals = parts.pedals;
  if constexpr (requires { one.speed_mps; }) one.speed_mps = parts.speed_mps;
  if constexpr (requires { one.text; }) one.text = parts.text;
  return Order(std::move(one));
}

template <std::size_t... kIndex>
Result<Order> make_nth(std::size_t n, const OrderParts& parts,
                       std::index_sequence<kIndex...> /*all*/) {
  using Make = Result<Order> (*)(const OrderParts&);
  constexpr std::array kMakers{Make{&make<std::variant_alternative_t<kIndex, Order>>}...};
  return kMakers[n](parts);
}

}  // namespace

std::optional<OrderKind> order_named(std::string_view name) noexcept {
  for (std::uint32_t kind = 1; kind <= std::variant_size_v<Order>; ++kind) {
    if (to_string(static_cast<OrderKind>(kind)) == name) return static_cast<OrderKind>(kind);
  }
  return std::nullopt;
}

OrderParts parts_of(const Order& order) noexcept {
  return std::visit(
      [](const auto& one) {
        OrderParts parts;
        if constexpr (requires { one.p_W; }) parts.points_W = std::span(&one.p_W, 1);
        if constexpr (requires { one.points_W; }) parts.points_W = one.points_W;
        if constexpr (requires { one.yaw_rad; }) parts.yaw_rad = one.yaw_rad;
        if constexpr (requires { one.v_mps; }) parts.v_mps = one.v_mps;
        if constexpr (requires { one.w_radps; }) parts.w_radps = one.w_radps;
        if constexpr (requires { one.vy_mps; }) parts.vy_mps = one.vy_mps;
        if constexpr (requires { one.pedals; }) parts.pedals = one.pedals;
        if constexpr (requires { one.speed_mps; }) parts.speed_mps = one.speed_mps;
        if constexpr (requires { one.text; }) parts.text = one.text;
        return parts;
      },
      order);
}

OrderParts parts_of(const Order* order) noexcept {
  return order != nullptr ? parts_of(*order) : OrderParts();
}

Result<Order> make_order(OrderKind kind, const OrderParts& parts) {
  constexpr std::size_t kCount = std::variant_size_v<Order>;
  const std::size_t n = static_cast<std::size_t>(kind) - 1;  // kNone becomes too large
  if (n >= kCount) return fail(ErrorCode::kInvalidArgument, "an order of an unknown kind");
  return make_nth(n, parts, std::make_index_sequence<kCount>());
}

Status check_path_size(std::size_t points) {
  if (points >= 2 && points <= kMostOrderPoints) return {};
  return fail(ErrorCode::kInvalidArgument, "a path has {} point{}; expected 2 to {}", points,
              points == 1 ? "" : "s", kMostOrderPoints);
}

}  // namespace rave::request
