// SPDX-License-Identifier: Apache-2.0
// Fair inboxes for messages from devices: who sends most makes room first.
#include "inbox_shares.hpp"

#include <algorithm>
#include <cstring>
#include <functional>

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
  if (bytes > box.max_bytes || fits(box, bytes)) return 0;
  // No message is dropped for one that would not fit even then.
  const std::uint32_t mine = count_of(from);
  // Tried on a copy: if there is no room even then, nothing has been taken out.
  std::vector<Share> left = shares_;
  std::vector<std::uint32_t> going;  // newest first
  std::vector<bool> goes(box.count);
  std::size_t used = box.bytes;
  while (box.count - going.size() >= box.max_messages || bytes > box.max_bytes - used) {
    const auto most = std::ranges::max_element(left, {}, &Share::count);
    // With fewer than two more than the new sender, the exchange would only turn the unfairness
    // round.
    if (most == left.end() || most->count < mine + 2) return 0;
    std::uint32_t newest = box.count - 1;
    while (goes[newest] || box.heads[newest].from != most->from) --newest;
    goes[newest] = true;
    going.push_back(newest);
    used -= box.heads[newest].size;
    --most->count;
  }
  // From the back, so that the numbers of those before stay right.
  std::ranges::sort(going, std::greater());
  for (const std::uint32_t message : going) take_out(box, message);
  shares_ = std::move(left);
  return static_cast<std::uint32_t>(going.size());
}

}  // namespace rave::sim
