// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/sim/pose_report.hpp"
#include "rave/sim/sent_packet.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

/// The state of a host.
enum class HostState : std::uint8_t {
  kRuns,
  kDone,    ///< The host requests the end of the run; set by the owner of the engine.
  kFailed,  ///< The host cannot continue; HostReport::text gives the reason.
};

/// The motions that simulated robots propose in a step: body velocities of their actuators. One
/// entry per robot in each array, robots ascending.
struct Proposals {
  std::vector<std::uint32_t> robots;  ///< RobotId.
  std::vector<double> vx_mps;         ///< Body frame; finite.
  std::vector<double> vy_mps;
  std::vector<double> wz_radps;

  void clear() noexcept {
    robots.clear();
    vx_mps.clear();
    vy_mps.clear();
    wz_radps.clear();
  }
};

/// The message of a host to the world authority, one per step: the host has completed step `step` -
/// 1 and is ready for `step`. The first report is for step 0, with no step completed. Doubles are
/// sent bit by bit. Frames: X_WR in the world frame, velocities in the body frame.
struct HostReport {
  std::uint32_t host = 0;  ///< Number of the host, see WorldAuthority::create().
  std::uint64_t step = 0;
  HostState state = HostState::kRuns;
  std::string text;  ///< Problem description for people; usually empty.
  /// Proposals of all simulated robots of the host in step `step` - 1. Empty for step 0.
  Proposals proposals;
  /// Messages that left robots of the host in step `step` - 1.
  SentPackets sent;
  /// Poses for step `step`: all robots of the host with a pose source, ascending.
  std::vector<PoseReport> poses;
  /// New samples of real robots since the last report, by (robot, stamp).
  std::vector<PoseSample> samples;
  /// Inputs of the last WorldStep that the host had to refuse.
  std::vector<InputRefusal> refusals;
  /// Requests of people to robots of this host, for the next WorldStep: kStop, kRelease, kArm and
  /// orders, each for one robot. `sequence` is the number that the host gave it. Written by the
  /// owner of the engine, which repeats it in each report until WorldStep::answers has it.
  std::vector<WorldInput> inputs;

  /// Resets all but the number of the host; keeps the allocated memory.
  void begin(std::uint64_t of_step) noexcept {
    step = of_step;
    state = HostState::kRuns;
    text.clear();
    proposals.clear();
    sent.clear();
    poses.clear();
    samples.clear();
    refusals.clear();
    inputs.clear();
  }
};

}  // namespace rave::sim
