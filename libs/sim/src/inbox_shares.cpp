// SPDX-License-Identifier: Apache-2.0
#include "inbox_shares.hpp"

#include <algorithm>
#include <cstring>

namespace rave::sim {
namespace {

bool fits(const Mailbox& box, std::size_t bytes) {
  return box.count < box.max_messages && bytes <= box.max_bytes - box.bytes;
}

void take_out(Mailbox& box, std::uint32_t index) {
  const MessageHead gone = box.heads[index];
  std::byte* const hole = box.data + gone.offset;
  std::memmove(hole, hole + gone.size, box.bytes - gone.offset - gone.size);
  box.bytes -= gone.size;
  // The bytes lie in the order of the heads.
  for (std::uint32_t i = index + 1; i < box.count; ++i) {
    box.heads[i - 1] = box.heads[i];
    box.heads[i - 1].offset -= gone.size;
  }
  --box.count;
  ++box.dropped;
}

}  // namespace

std::uint32_t InboxShares::count_of(std::uint32_t from) const noexcept {
  const auto found = std::ranges::find(shares_, from, &Share::from);
  return found == shares_.end() ? 0 : found->count;
}

void InboxShares::add(std::uint32_t from) {
  const auto found = std::ranges::find(shares_, from, &Share::from);
  if (found != shares_.end()) {
    ++found->count;
  } else {
    shares_.push_back({from, 1});
  }
}

std::uint32_t InboxShares::make_room(Mailbox& box, std::uint32_t from, std::size_t bytes) {
  std::uint32_t taken = 0;
  if (bytes > box.max_bytes) return taken;
  while (!fits(box, bytes) && !shares_.empty()) {
    Share& most = *std::ranges::max_element(shares_, {}, &Share::count);
    if (most.count < count_of(from) + 2) break;
    std::uint32_t newest = box.count;
    while (box.heads[--newest].from != most.from) {
    }
    take_out(box, newest);
    --most.count;
    ++taken;
  }
  return taken;
}

}  // namespace rave::sim
