// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/topics.hpp"
#include "rave/protocol/obstacle_messages.hpp"
#include "rave/sim/host_report.hpp"
#include "rave/sim/world_authority.hpp"
#include "rave/sim/world_step.hpp"

namespace rave::lock_step {

/// Memory for what a bus message of messages between robots points to.
struct WireParts {
  std::vector<rave_wire_PoseReport> poses;
  std::vector<rave_wire_PoseSample> samples;
  std::vector<rave_wire_SentPacket> packets;
};

/// Makes a bus message of a host's report. One owner thread.
class ReportMessage {
 public:
  /// The message borrows from `report` and from this object: it holds until either changes.
  /// `epoch`: of the authority that is answered, 0 if none has spoken. `hash`: of what the host did
  /// in the steps that are done.
  [[nodiscard]] bus::HostReport& fill(const sim::HostReport& report, std::uint64_t epoch,
                                      std::uint64_t hash);

 private:
  bus::HostReport message_{};
  WireParts parts_;
  std::vector<rave_wire_InputRefusal> refusals_;
};

/// Makes a bus message of a step of the world. One owner thread.
class WorldMessage {
 public:
  /// As ReportMessage::fill(). Errors: kInvalidArgument, an input that the bus cannot carry: a name
  /// longer than 128 bytes, a text longer than 1024, a list of more than 1024 numbers; what
  /// ObstacleParts::fill() says.
  [[nodiscard]] Result<bus::LastWorld*> fill(const sim::WorldStep& world,
                                             const sim::AuthorityState& authority,
                                             std::uint64_t epoch);
  /// Says for whom the message is: by number of the host the process that runs it, 0 for nobody.
  void address(std::span<const std::uint64_t> hosts);

 private:
  Status fill_inputs(const sim::WorldStep& world);
  Status fill_authority(const sim::AuthorityState& authority);

  bus::LastWorld message_{};
  WireParts parts_;
  std::vector<rave_wire_PushedRobot> pushed_;
  std::vector<rave_wire_TouchPoint> touches_;
  std::vector<rave_wire_ResizedRobot> resized_;
  std::vector<rave_wire_ResizedRobot> scales_;
  std::vector<rave_wire_NotedEvent> events_;
  std::vector<rave_wire_RefusedChange> refused_;
  std::vector<std::uint32_t> pinned_;
  std::vector<std::uint64_t> hosts_;
  std::vector<rave_wire_WorldInput> inputs_;
  ObstacleParts obstacles_;
  ObstacleParts obstacles_before_;
  std::vector<std::vector<rave_wire_ParameterChange>> changes_;
  std::vector<std::vector<rave_wire_OrderPoint>> points_;  ///< By input.
};

/// Whether the bus can carry what is asked; error as of WorldMessage::fill().
[[nodiscard]] Status check_fits(const sim::WorldInput& input);

/// What a message says, with the memory of `report` used again. Whether it is what the authority
/// needs is for WorldAuthority::step() to say. The message has passed bus::validate().
void read(const bus::HostReport& message, sim::HostReport& report);
/// The same for a step of the world, which Engine::apply() judges, and what its authority knows
/// beside. Errors: kInvalidArgument (an input or a part of a robot that does not exist, an event of
/// no robot that is not of the world, an obstacle that nobody can build).
[[nodiscard]] Status read(const bus::WorldStep& message, sim::WorldStep& world,
                          sim::AuthorityState& authority);

}  // namespace rave::lock_step
