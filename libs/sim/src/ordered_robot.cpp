// SPDX-License-Identifier: Apache-2.0
// Orders that wait for the next decision of a program, and as the program sees them.
#include <algorithm>
#include <functional>

#include "order_book.hpp"
#include "order_checks.hpp"

namespace rave::sim {

void OrderedRobot::wait_for_program(const WorldInput& input) {
  const auto is_text = [](const WorldInput& one) { return one.is<request::Text>(); };
  // The newest motion replaces those before it; texts are all kept, up to a limit.
  if (!is_text(input)) {
    std::erase_if(waiting, std::not_fn(is_text));
  } else if (waiting.size() >= kMostWaitingOrders) {
    waiting.erase(std::find_if(waiting.begin(), waiting.end(), is_text));
  }
  waiting.push_back(input);
}

void OrderedRobot::show() {
  shown.swap(waiting);
  waiting.clear();
  items.clear();
  for (const WorldInput& input : shown) {
    OrderItem& item = items.emplace_back();
    const request::OrderParts order = order_parts(input);
    item.kind = order_kind(input);
    item.points = order.points_W.data();
    item.point_count = static_cast<std::uint32_t>(order.points_W.size());
    item.has_yaw = order.yaw_rad ? 1 : 0;
    item.yaw_rad = order.yaw_rad.value_or(0);
    item.speed_mps = order.speed_mps;
    item.text = order.text.data();
    item.text_size = static_cast<std::uint32_t>(order.text.size());
    item.by = input.author.name.data();
    item.by_size = static_cast<std::uint32_t>(input.author.name.size());
  }
}

}  // namespace rave::sim
