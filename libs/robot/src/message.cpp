// SPDX-License-Identifier: Apache-2.0
#include "rave/robot/message.hpp"

#include <cstring>

namespace rave {

bool Mailbox::put(const MessageHead& head, std::span<const std::byte> text) noexcept {
  if (count >= max_messages || text.size() > max_bytes - bytes) {
    ++dropped;
    return false;
  }
  MessageHead& place = heads[count++];
  place = head;
  place.offset = bytes;
  place.size = static_cast<std::uint32_t>(text.size());
  if (!text.empty()) std::memcpy(data + bytes, text.data(), text.size());
  bytes += place.size;
  return true;
}

}  // namespace rave
