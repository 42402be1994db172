// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "inbox_shares.hpp"
#include "instances.hpp"
#include "packet_store.hpp"
#include "radio_port.hpp"
#include "rave/sim/radio.hpp"
#include "rave/world/shape_grid.hpp"

namespace rave::sim {

inline constexpr std::uint32_t kNobody = 0xFFFF'FFFFU;

/// The message model of one communicator of one type of robot.
struct RadioModel {
  const CommunicatorSpec* spec = nullptr;
  InstanceArray instance;
  RadioDeclaration declaration;
  bool failed = false;
};

/// One communicator of one robot. Endpoints are numbered by (robot, communicator).
struct Endpoint {
  std::uint32_t robot = 0;
  std::uint32_t device = 0;  ///< Index among the robot's communicators.
  std::uint32_t model = 0;
  std::uint32_t channel = 0;
  std::uint32_t line = 0;
  std::uint32_t team = kNobody;  ///< None: it has no team.
  Mailbox in;
  Mailbox out;
  InboxShares shares;  ///< Of `in`; in a live run.
  std::uint32_t sequence = 0;
  // Sending:
  std::vector<std::uint32_t> waiting;  ///< Packets, oldest first, from `first_waiting` on.
  std::uint32_t first_waiting = 0;
  std::uint32_t queue_bytes = 0;  ///< Waiting or on the air.
  std::int64_t free_ns = 0;       ///< When it may begin to send the next one.

  [[nodiscard]] bool has_waiting() const noexcept { return first_waiting < waiting.size(); }
  std::uint32_t pop() {
    const std::uint32_t packet = waiting[first_waiting++];
    if (!has_waiting()) {
      waiting.clear();
      first_waiting = 0;
    } else if (first_waiting >= 64) {
      // Now and then the used-up front is cut off.
      waiting.erase(waiting.begin(), waiting.begin() + first_waiting);
      first_waiting = 0;
    }
    return packet;
  }
};

/// One transmitter of one robot.
struct RadioLine {
  const TransmitterSpec* spec = nullptr;
  std::uint32_t robot = 0;
  std::uint32_t device = 0;            ///< Index among the robot's transmitters.
  std::vector<std::uint32_t> senders;  ///< Endpoints, ascending.
  TransmitterDeclaration declaration;
  std::int64_t free_ns = 0;
  std::vector<std::uint32_t> on_air;  ///< Packets that are being sent, in the order of their ends.
  std::uint32_t under_way = 0;        ///< Waiting or on the air.
  // A device:
  InstanceArray instance;
  std::unique_ptr<RadioPort> port;
  RepeatFilter repeats;
  std::vector<std::uint32_t> flooders;  ///< Hashes of senders that were complained of.
  bool open = false;
  bool failed = false;
};

/// All communicators of one name that are carried in this process.
struct Channel {
  std::string name;
  std::uint32_t hash = 0;
  std::vector<std::uint32_t> members;     ///< Endpoints, ascending.
  std::vector<std::uint32_t> team_sizes;  ///< By team.
  world::ShapeGrid grid;                  ///< Of reported positions; shape: endpoint.
  bool placed = false;                    ///< `grid` shows this step.
  double largest_range_m = 0;             ///< Of those that have a range.
};

/// The time that sending `bytes` takes; a rate of 0 takes none.
[[nodiscard]] std::int64_t sending_ns(std::uint32_t bytes, double byte_rate) noexcept;

/// Sends what a line has, up to (not including) `until_ns`: of the communicators that share it the
/// one that may begin first, among equals the one of the lowest number. Each goes no faster than
/// its own rate and all together no faster than that of the line. Packets whose last byte leaves by
/// `until_ns` are added to `complete`, in the order in which they do.
void send_waiting(RadioLine& line, std::vector<Endpoint>& endpoints,
                  const std::vector<RadioModel>& models, PacketStore& packets,
                  std::int64_t until_ns, std::vector<std::uint32_t>& complete);

}  // namespace rave::sim
