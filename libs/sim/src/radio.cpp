// SPDX-License-Identifier: Apache-2.0
// A step of the radio: deliver, collect, send, reach. What a phase does is in
// docs/explanation/radio.md; the models and devices are made in radio_make.cpp.
#include "radio.hpp"

#include <algorithm>

namespace rave::sim {
namespace {

/// Packets that one thread takes at a time. Part of no result.
constexpr std::size_t kBlockSize = 16;

// Sender first: deliveries of a step are sorted by this number.
std::uint64_t order_of(std::uint32_t endpoint, std::uint32_t sequence) {
  return (std::uint64_t{endpoint} << 32U) | sequence;
}

}  // namespace

RadioCounts& RadioCounts::operator+=(const RadioCounts& other) noexcept {
  offered += other.offered;
  refused += other.refused;
  sent += other.sent;
  lost_queue += other.lost_queue;
  lost_device += other.lost_device;
  addressed += other.addressed;
  delivered += other.delivered;
  lost_range += other.lost_range;
  lost_obstacle += other.lost_obstacle;
  lost_chance += other.lost_chance;
  lost_mailbox += other.lost_mailbox;
  heard += other.heard;
  foreign += other.foreign;
  repeated += other.repeated;
  garbled += other.garbled;
  overrun += other.overrun;
  return *this;
}

void Radio::deliver(const RadioMoment& moment) {
  // Observers of the last step have read the traces, which refer to the bytes of these packets.
  for (const std::uint32_t packet : done_) packets_.release(packet);
  done_.clear();
  traces_.clear();
  trace_packets_.clear();
  std::vector<Delivery>& due = arrivals_.take(moment.step);
  for (const Delivery& delivery : due) {
    hand_over(moment, endpoints_[delivery.to], packets_[delivery.packet].head, delivery.packet);
    done_.push_back(delivery.packet);
  }
  due.clear();
  hear(moment);
}

void Radio::hand_over(const RadioMoment& moment, Endpoint& to, MessageHead head,
                      std::uint32_t packet) {
  const std::span<const std::byte> bytes = packets_.bytes_of(packet);
  // Anybody may send to a device, so no sender may crowd out the others. In a stepped run the order
  // of the messages is fixed, and the last ones are lost.
  if (live_) {
    const std::uint32_t pushed_out = to.shares.make_room(to.in, head.from, bytes.size());
    counts_.delivered -= pushed_out;
    counts_.lost_mailbox += pushed_out;
  }
  const bool fits = to.in.put(head, bytes);
  if (live_ && fits) to.shares.add(head.from);
  ++(fits ? counts_.delivered : counts_.lost_mailbox);
  ItemHash item(moment.step, to.robot, HashChannel::kRadio, to.device);
  item.add(order_of(head.from, head.sequence));
  item.add(static_cast<std::uint64_t>(head.stamp_ns));
  item.add(packets_[packet].content_hash);
  item.add(std::uint64_t{fits});
  moment.hash->add(item);
  if (!fits) return;
  trace(head, to, true, moment.now.ns, packet);
}

void Radio::trace(const MessageHead& head, const Endpoint& at, bool delivered,
                  std::int64_t complete_ns, std::uint32_t packet) {
  traces_.push_back({RobotId(head.from),
                     delivered ? RobotId(at.robot) : RobotId(),
                     at.device,
                     delivered,
                     head.sequence,
                     head.stamp_ns,
                     complete_ns,
                     {}});
  trace_packets_.push_back(packet);
}

void Radio::show_payloads() {
  // Not before the end of the step: until then the store may move.
  for (std::size_t i = 0; i < traces_.size(); ++i) {
    traces_[i].payload = packets_.bytes_of(trace_packets_[i]);
  }
}

void Radio::collect(const RadioMoment& moment, RobotId robot, bool accepted) {
  for (std::uint32_t e = first_endpoint_[robot.value()]; e < first_endpoint_[robot.value() + 1];
       ++e) {
    Endpoint& endpoint = endpoints_[e];
    // The program has decided, so it has read its inbox.
    endpoint.in.clear();
    endpoint.shares.clear();
    if (accepted) {
      counts_.refused += endpoint.out.dropped;
      for (std::uint32_t i = 0; i < endpoint.out.count; ++i) {
        offer(moment, endpoint, endpoint.out.heads[i]);
      }
    }
    endpoint.out.clear();
  }
}

void Radio::offer(const RadioMoment& moment, Endpoint& sender, const MessageHead& message) {
  if (message.to.kind > RecipientKind::kTeam) {
    ++counts_.refused;  // no address that there is
    return;
  }
  ++counts_.offered;
  const RadioDeclaration& radio = models_[sender.model].declaration;
  const std::uint32_t cost = message.size + radio.overhead_bytes;
  // The number is used up even if the message is lost, as a receiver can tell that it missed one.
  const std::uint32_t sequence = ++sender.sequence;
  if (radio.max_queue_bytes > 0 && sender.queue_bytes + cost > radio.max_queue_bytes) {
    ++counts_.lost_queue;
    return;
  }
  StoredPacket packet;
  packet.head = message;
  // Sender, number and stamp are set here: a program cannot speak in the name of another robot.
  packet.head.from = sender.robot;
  packet.head.sequence = sequence;
  packet.head.stamp_ns = moment.now.ns;
  packet.head.offset = 0;
  packet.endpoint = static_cast<std::uint32_t>(&sender - endpoints_.data());
  packet.cost_bytes = cost;
  packet.queued_ns = moment.now.ns;
  const std::span<const std::byte> bytes = sender.out.bytes_of(message);
  packet.content_hash = content_hash(bytes);
  sender.queue_bytes += cost;
  sender.waiting.push_back(packets_.add(packet, bytes));
  ++lines_[sender.line].under_way;
}

void Radio::send_out(const RadioMoment& moment) {
  complete_.clear();
  carried_.clear();
  const std::int64_t until_ns = moment.now.ns + spec_.step.ns;
  for (RadioLine& line : lines_) {
    send_waiting(line, endpoints_, models_, packets_, until_ns, complete_);
  }
  for (const std::uint32_t packet : complete_) {
    const Endpoint& sender = endpoints_[packets_[packet].endpoint];
    RadioLine& line = lines_[sender.line];
    if (line.declaration.in_process == 0) {
      transmit(moment, line, packet);
      continue;
    }
    ++counts_.sent;
    carried_.push_back(packet);
    // The position when the last byte leaves, which the receiver measures its distance from.
    packets_[packet].origin = origin_of(moment, sender);
    trace(packets_[packet].head, sender, false, packets_[packet].complete_ns, packet);
  }
}

PacketOrigin Radio::origin_of(const RadioMoment& moment, const Endpoint& sender) const {
  const RadioDeclaration& radio = models_[sender.model].declaration;
  const ReportedPose& pose = moment.reported[sender.robot];
  return {{pose.pose.x_m, pose.pose.y_m},
          radio.range_m,
          radio.antenna_z_m,
          pose.known,
          radio.line_of_sight != 0};
}

void Radio::carry(const RadioMoment& moment) {
  send_out(moment);
  find_receivers(moment);
  for (const Reach& found : reaches_) {
    if (found.failed_model != kNobody) count_failure(moment, found);
  }
  // Each sent packet was in use by its queue.
  done_.insert(done_.end(), complete_.begin(), complete_.end());
  show_payloads();
}

/// Fills `reaches_` and `arrivals_` with what becomes of the packets in `carried_`.
void Radio::find_receivers(const RadioMoment& moment) {
  for (Channel& channel : channels_) channel.placed = false;
  // Only broadcasts with a range need the grid, and only on their channels.
  for (const std::uint32_t packet : carried_) {
    const StoredPacket& sent = packets_[packet];
    if (sent.origin.range_m > 0 && sent.head.to.kind != RecipientKind::kRobot) {
      place(channels_[endpoints_[sent.endpoint].channel], moment);
    }
  }
  const std::size_t blocks = (carried_.size() + kBlockSize - 1) / kBlockSize;
  if (reaches_.size() < blocks) reaches_.resize(blocks);
  // Those of an earlier step with more blocks must not report their failure again.
  for (std::size_t b = blocks; b < reaches_.size(); ++b) reaches_[b].failed_model = kNobody;
  pool_.for_each_block(blocks, effort_, [&](std::size_t b, unsigned) {
    Reach& found = reaches_[b];
    found.deliveries.clear();
    found.arrivals.clear();
    found.counts = {};
    found.failed_model = kNobody;
    const std::size_t end = std::min(carried_.size(), (b + 1) * kBlockSize);
    for (std::size_t i = b * kBlockSize; i < end; ++i) reach(carried_[i], moment, found);
  });
  for (std::size_t b = 0; b < blocks; ++b) {
    // In the order of the blocks, whichever thread was first.
    const Reach& found = reaches_[b];
    counts_ += found.counts;
    for (std::size_t i = 0; i < found.deliveries.size(); ++i) {
      packets_.use(found.deliveries[i].packet);
      arrivals_.add(found.arrivals[i], found.deliveries[i]);
    }
  }
}

void Radio::count_failure(const RadioMoment& moment, const Reach& reach) {
  RadioModel& model = models_[reach.failed_model];
  if (model.failed) return;
  model.failed = true;
  for (const Endpoint& endpoint : endpoints_) {
    if (endpoint.model != reach.failed_model) continue;
    moment.events->push_back({moment.step, RobotId(endpoint.robot), EventKind::kDriverFailed,
                              BodyId(),
                              fmt::format("communicator `{}` (driver `{}`): {}", model.spec->name,
                                          model.spec->driver, reach.failure)});
  }
}

}  // namespace rave::sim
