// SPDX-License-Identifier: Apache-2.0
// Messages of several hosts in lock-step: sent by the host of the sender, judged by each host for
// its own receivers in the step after.
#include <algorithm>

#include "radio.hpp"

namespace rave::sim {

void Radio::send(const RadioMoment& moment, SentPackets& sent) {
  send_out(moment);
  write_sent(sent);
  done_.insert(done_.end(), complete_.begin(), complete_.end());
  show_payloads();
}

void Radio::write_sent(SentPackets& sent) {
  sent.clear();
  // Endpoints are numbered by (robot, communicator).
  std::sort(carried_.begin(), carried_.end(), [this](std::uint32_t a, std::uint32_t b) {
    const StoredPacket& first = packets_[a];
    const StoredPacket& second = packets_[b];
    return first.endpoint != second.endpoint ? first.endpoint < second.endpoint
                                             : first.head.sequence < second.head.sequence;
  });
  for (const std::uint32_t id : carried_) {
    const StoredPacket& stored = packets_[id];
    SentPacket packet;
    packet.robot = RobotId(stored.head.from);
    packet.communicator = endpoints_[stored.endpoint].device;
    packet.sequence = stored.head.sequence;
    packet.to = stored.head.to;
    packet.stamp_ns = stored.head.stamp_ns;
    packet.complete_ns = stored.complete_ns;
    packet.x_m = stored.origin.p_W.x;
    packet.y_m = stored.origin.p_W.y;
    packet.range_m = stored.origin.range_m;
    packet.antenna_z_m = stored.origin.antenna_z_m;
    packet.located = stored.origin.located ? 1 : 0;
    packet.line_of_sight = stored.origin.line_of_sight ? 1 : 0;
    sent.add(packet, packets_.bytes_of(id));
  }
}

Status Radio::receive(const RadioMoment& moment, const SentPackets& sent) {
  carried_.clear();
  std::uint32_t longest = 0;
  // Every host has the messages of all, its own included, and decides for its own receivers only.
  for (const SentPacket& packet : sent.packets) longest = std::max(longest, packet.size);
  packets_.widen(longest);
  for (const SentPacket& packet : sent.packets) {
    StoredPacket stored;
    stored.head.stamp_ns = packet.stamp_ns;
    stored.head.from = packet.robot.value();
    stored.head.sequence = packet.sequence;
    stored.head.to = packet.to;
    stored.head.size = packet.size;
    stored.endpoint = first_endpoint_[packet.robot.value()] + packet.communicator;
    stored.complete_ns = packet.complete_ns;
    stored.origin = {{packet.x_m, packet.y_m},
                     packet.range_m,
                     packet.antenna_z_m,
                     packet.located != 0,
                     packet.line_of_sight != 0};
    const std::span<const std::byte> bytes = sent.bytes_of(packet);
    // Computed anew: it goes into the run hash and is not taken from another process.
    stored.content_hash = content_hash(bytes);
    carried_.push_back(packets_.add(stored, bytes));
  }
  find_receivers(moment);
  for (const std::uint32_t packet : carried_) packets_.release(packet);
  // The store may have moved.
  show_payloads();
  for (const Reach& found : reaches_) {
    if (found.failed_model == kNobody) continue;
    const CommunicatorSpec& communicator = *models_[found.failed_model].spec;
    return fail(ErrorCode::kPlugin,
                "communicator `{}` (driver `{}`): {}; the run ends here, because the other hosts "
                "would continue with theirs",
                communicator.name, communicator.driver, found.failure);
  }
  return {};
}

}  // namespace rave::sim
