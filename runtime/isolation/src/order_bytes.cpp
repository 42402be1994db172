// SPDX-License-Identifier: Apache-2.0
#include "order_bytes.hpp"

#include <algorithm>
#include <cstring>

namespace rave::isolation {
namespace {

/// The header of an order in memory; its points, text and author follow, padded to whole words.
struct OrderHead {
  std::uint32_t kind = 0;
  std::uint32_t point_count = 0;
  double yaw_rad = 0;
  double speed_mps = 0;
  std::uint32_t text_size = 0;
  std::uint32_t by_size = 0;
  std::uint32_t has_yaw = 0;
  std::uint32_t reserved = 0;
};

std::size_t bytes_of(const OrderHead& head) noexcept {
  const std::size_t bytes =
      sizeof head + std::size_t{head.point_count} * sizeof(Vec2) + head.text_size + head.by_size;
  // Whole words keep the points of the next order aligned for doubles.
  return (bytes + 7) / 8 * 8;
}

struct AnswerHead {
  std::uint32_t size = 0;
  std::uint32_t done = 0;
};

}  // namespace

SharedOrders write_orders(const DecideItem& item, std::byte* to) noexcept {
  SharedOrders shared;
  shared.driven = item.driven;
  shared.listens = item.answers != nullptr ? 1 : 0;
  for (std::uint32_t i = 0; i < item.order_count; ++i) {
    const OrderItem& order = item.orders[i];
    const OrderHead head{static_cast<std::uint32_t>(order.kind),
                         order.point_count,
                         order.yaw_rad,
                         order.speed_mps,
                         order.text_size,
                         order.by_size,
                         order.has_yaw,
                         0};
    const std::size_t bytes = bytes_of(head);
    // There is room for a path, some texts and their authors. Orders that do not fit are left out.
    if (shared.bytes + bytes > kOrderBytes) break;
    std::byte* at = to + shared.bytes;
    const auto put = [&at](const void* from, std::size_t size) {
      if (size > 0) std::memcpy(at, from, size);
      at += size;
    };
    put(&head, sizeof head);
    put(order.points, std::size_t{order.point_count} * sizeof(Vec2));
    put(order.text, order.text_size);
    put(order.by, order.by_size);
    shared.bytes += static_cast<std::uint32_t>(bytes);
    ++shared.count;
  }
  return shared;
}

// Runs in the child, which trusts the host; take_answers() runs in the host and trusts no number of
// the child.
void read_orders(const SharedOrders& shared, const std::byte* from, std::vector<OrderItem>& items) {
  items.clear();
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < shared.count; ++i) {
    OrderHead head;
    std::memcpy(&head, from + at, sizeof head);
    OrderItem& order = items.emplace_back();
    order.kind = static_cast<OrderKind>(head.kind);
    order.point_count = head.point_count;
    order.yaw_rad = head.yaw_rad;
    order.speed_mps = head.speed_mps;
    order.has_yaw = head.has_yaw;
    order.text_size = head.text_size;
    order.by_size = head.by_size;
    const std::byte* const points = from + at + sizeof head;
    order.points = reinterpret_cast<const Vec2*>(points);
    order.text = reinterpret_cast<const char*>(points + head.point_count * sizeof(Vec2));
    order.by = order.text + head.text_size;
    at += bytes_of(head);
  }
}

bool AnswerWriter::say(std::span<const char> text, std::uint32_t done) noexcept {
  const AnswerHead head{static_cast<std::uint32_t>(text.size()), done};
  if (text.size() > kMostOrderText || head_->bytes + sizeof head + text.size() > kAnswerBytes) {
    return false;
  }
  std::memcpy(bytes_ + head_->bytes, &head, sizeof head);
  std::memcpy(bytes_ + head_->bytes + sizeof head, text.data(), text.size());
  head_->bytes += static_cast<std::uint32_t>(sizeof head + text.size());
  ++head_->count;
  return true;
}

void take_answers(const SharedAnswers& shared, const std::byte* bytes, const DecideItem& item) {
  if (item.answers == nullptr) return;
  // Both numbers come from the child: the loop ends with the bytes, whatever the count says.
  const std::size_t end = std::min<std::size_t>(shared.bytes, kAnswerBytes);
  std::size_t at = 0;
  for (std::uint32_t i = 0; i < shared.count && at + sizeof(AnswerHead) <= end; ++i) {
    AnswerHead head;
    std::memcpy(&head, bytes + at, sizeof head);
    at += sizeof head;
    if (head.size > end - at) return;
    static_cast<void>(item.answers->say(item.answers->context, item.robot,
                                        reinterpret_cast<const char*>(bytes + at), head.size,
                                        head.done));
    at += head.size;
  }
}

}  // namespace rave::isolation
