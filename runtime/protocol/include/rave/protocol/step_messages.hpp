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

/// Memory that bus messages refer to.
struct WireParts {
  std::vector<rave_wire_PoseReport> poses;
  std::vector<rave_wire_PoseSample> samples;
  std::vector<rave_wire_SentPacket> packets;
};

/// Inputs as members of bus messages. One owner thread.
class InputParts {
 public:
  /// The members borrow from the inputs and from this object. Errors: kInvalidArgument: the bus
  /// cannot carry an input; inputs() then has those before it.
  Status fill(const std::vector<sim::WorldInput>& inputs);
  [[nodiscard]] std::vector<rave_wire_WorldInput>& inputs() noexcept { return inputs_; }

 private:
  std::vector<rave_wire_WorldInput> inputs_;
  std::vector<std::vector<rave_wire_ParameterChange>> changes_;
  std::vector<std::vector<rave_wire_OrderPoint>> points_;  ///< By input.
};

/// Encodes the report of a host as a bus message. One owner thread.
class ReportMessage {
 public:
  /// The message borrows from `report` and from this object: valid until either changes. `epoch`:
  /// that of the authority that is answered, 0 if none. `hash`: hash of the completed steps of this
  /// host. Inputs from the first one on that check_fits() refuses are left out.
  [[nodiscard]] bus::HostReport& fill(const sim::HostReport& report, std::uint64_t epoch,
                                      std::uint64_t hash);

 private:
  bus::HostReport message_{};
  WireParts parts_;
  std::vector<rave_wire_InputRefusal> refusals_;
  InputParts inputs_;
};

/// Encodes a step of the world as a bus message. One owner thread.
class WorldMessage {
 public:
  /// Like ReportMessage::fill(). Errors: kInvalidArgument: an input that the bus cannot carry (a
  /// name longer than 128 bytes, a text longer than 1024, a list of more than 1024 numbers); those
  /// of ObstacleParts::fill().
  [[nodiscard]] Result<bus::LastWorld*> fill(const sim::WorldStep& world,
                                             const sim::AuthorityState& authority,
                                             std::uint64_t epoch);
  /// Sets the receivers: for each host the writer id of its process, 0: none.
  void address(std::span<const std::uint64_t> hosts);

 private:
  void fill_answers(const sim::WorldStep& world);
  Status fill_authority(const sim::AuthorityState& authority);

  bus::LastWorld message_{};
  WireParts parts_;
  std::vector<rave_wire_PushedRobot> pushed_;
  std::vector<rave_wire_TouchPoint> touches_;
  std::vector<rave_wire_ResizedRobot> resized_;
  std::vector<rave_wire_ResizedRobot> scales_;
  std::vector<rave_wire_NotedEvent> events_;
  std::vector<rave_wire_RefusedChange> refused_;
  std::vector<std::uint8_t> conductor_;
  std::vector<std::uint32_t> pinned_;
  std::vector<std::uint64_t> hosts_;
  InputParts inputs_;
  std::vector<rave_wire_InputAnswer> answers_;
  std::vector<rave_wire_InputRefusal> refusals_;
  ObstacleParts obstacles_;
  ObstacleParts obstacles_before_;
};

/// Checks that the bus can carry an input; errors as in WorldMessage::fill().
[[nodiscard]] Status check_fits(const sim::WorldInput& input);

/// Decodes a message that has passed bus::validate(). Reuses the memory of `report`.
/// WorldAuthority::step() checks whether it fits the run. Error kInvalidArgument: an unknown kind
/// of input.
[[nodiscard]] Status read(const bus::HostReport& message, sim::HostReport& report);
/// Decodes a step of the world, which Engine::apply() checks, and the state of its authority.
/// Errors: kInvalidArgument (an unknown kind of input or part of a robot, an event without a robot
/// that does not concern the world, an invalid obstacle).
[[nodiscard]] Status read(const bus::WorldStep& message, sim::WorldStep& world,
                          sim::AuthorityState& authority);

}  // namespace rave::lock_step
