// SPDX-License-Identifier: Apache-2.0
// When messages leave: rates of communicators and of transmitters that several share.
#include <algorithm>
#include <cmath>
#include <limits>

#include "radio_parts.hpp"

namespace rave::sim {
namespace {

struct Start {
  std::int64_t at_ns = std::numeric_limits<std::int64_t>::max();
  std::uint32_t endpoint = kNobody;
};

/// Who may begin first.
Start next_start(const RadioLine& line, const std::vector<Endpoint>& endpoints,
                 const PacketStore& packets) {
  Start first;
  for (const std::uint32_t e : line.senders) {
    const Endpoint& sender = endpoints[e];
    if (!sender.has_waiting()) continue;
    const std::int64_t at_ns = std::max(
        {sender.free_ns, line.free_ns, packets[sender.waiting[sender.first_waiting]].queued_ns});
    // Of equal ones the first in the list, which is that of the first communicator in the file.
    if (at_ns < first.at_ns) first = {at_ns, e};
  }
  return first;
}

}  // namespace

std::int64_t sending_ns(std::uint32_t bytes, double byte_rate) noexcept {
  if (!(byte_rate > 0)) return 0;
  constexpr double kNever_ns = 1e18;
  return static_cast<std::int64_t>(std::min(std::ceil(bytes * 1e9 / byte_rate), kNever_ns));
}

void send_waiting(RadioLine& line, std::vector<Endpoint>& endpoints,
                  const std::vector<RadioModel>& models, PacketStore& packets,
                  std::int64_t until_ns, std::vector<std::uint32_t>& complete) {
  if (line.under_way == 0) return;
  const double line_rate = line.declaration.byte_rate;
  const auto ends_earlier = [&](std::uint32_t a, std::uint32_t b) {
    return packets[a].complete_ns < packets[b].complete_ns;
  };
  // A simulation by events within the step: who may begin first sends next and occupies its own
  // radio and the transmitter for as long as each needs. Whole nanoseconds, so nothing depends on
  // the step.
  for (;;) {
    const Start start = next_start(line, endpoints, packets);
    if (start.endpoint == kNobody || start.at_ns >= until_ns) break;
    Endpoint& sender = endpoints[start.endpoint];
    const std::uint32_t id = sender.pop();
    StoredPacket& packet = packets[id];
    sender.free_ns =
        start.at_ns + sending_ns(packet.cost_bytes, models[sender.model].declaration.byte_rate);
    line.free_ns = start.at_ns + sending_ns(packet.cost_bytes, line_rate);
    // The slower of both: a message has left when its radio and the shared transmitter are done
    // with it.
    packet.complete_ns = std::max(sender.free_ns, line.free_ns);
    const auto place = std::upper_bound(line.on_air.begin(), line.on_air.end(), id, ends_earlier);
    line.on_air.insert(place, id);
  }
  // What began in this step may end in a later one; it stays on the air until then.
  std::size_t done = 0;
  for (; done < line.on_air.size(); ++done) {
    StoredPacket& packet = packets[line.on_air[done]];
    if (packet.complete_ns > until_ns) break;
    endpoints[packet.endpoint].queue_bytes -= packet.cost_bytes;
    complete.push_back(line.on_air[done]);
  }
  line.under_way -= static_cast<std::uint32_t>(done);
  line.on_air.erase(line.on_air.begin(), line.on_air.begin() + static_cast<std::ptrdiff_t>(done));
}

}  // namespace rave::sim
