// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "rave/robot/message.hpp"

namespace rave::sim {

/// How many messages of whom are in one inbox. In a live run it is unknown which robots of other
/// processes behave; so when the inbox is full, who has most in it makes room for who has less.
/// One owner thread.
class InboxShares {
 public:
  /// A message of this sender was put in.
  void add(std::uint32_t from);
  /// The inbox was emptied.
  void clear() noexcept { shares_.clear(); }
  /// Makes room for a message of `bytes` from `from`, as long as another sender has at least two
  /// more in the inbox than that: takes out the newest of who has most. Returns how many were taken
  /// out; they count as dropped.
  std::uint32_t make_room(Mailbox& box, std::uint32_t from, std::size_t bytes);

 private:
  struct Share {
    std::uint32_t from = 0;
    std::uint32_t count = 0;
  };
  [[nodiscard]] std::uint32_t count_of(std::uint32_t from) const noexcept;

  std::vector<Share> shares_;
};

}  // namespace rave::sim
