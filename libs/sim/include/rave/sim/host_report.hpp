// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rave/sim/pose_report.hpp"
#include "rave/sim/sent_packet.hpp"
#include "rave/sim/world_input.hpp"

namespace rave::sim {

/// How it stands with a host.
enum class HostState : std::uint8_t {
  kRuns,
  kDone,    ///< It wants the run to end; set by who runs the engine.
  kFailed,  ///< It cannot go on: HostReport::text says why.
};

/// What simulated robots want to do in a step: body velocities that their actuators propose. One
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

/// The message of a host to the authority of its world, one per step: the host has done step
/// `step` - 1 and is ready for `step`. In the first one, of step 0, nothing has been done yet.
/// Doubles travel bit by bit. Frames: X_WR in the world frame, velocities in the body frame.
struct HostReport {
  std::uint32_t host = 0;  ///< Number of the host, see WorldAuthority::create().
  std::uint64_t step = 0;
  HostState state = HostState::kRuns;
  std::string text;  ///< For people; empty unless something is wrong.
  /// Of step `step` - 1: what all simulated robots of the host propose. Empty for step 0.
  Proposals proposals;
  /// Messages that left robots of the host in step `step` - 1.
  SentPackets sent;
  /// Of step `step`: all robots of the host that have a source of their pose, ascending.
  std::vector<PoseReport> poses;
  /// New samples of real robots since the last report, by (robot, stamp).
  std::vector<PoseSample> samples;
  /// Inputs of the last WorldStep that the host could not carry out.
  std::vector<InputRefusal> refusals;

  /// Drops all but the number of the host, and keeps the memory.
  void begin(std::uint64_t of_step) noexcept {
    step = of_step;
    state = HostState::kRuns;
    text.clear();
    proposals.clear();
    sent.clear();
    poses.clear();
    samples.clear();
    refusals.clear();
  }
};

}  // namespace rave::sim
