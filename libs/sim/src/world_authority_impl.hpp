// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "message_checks.hpp"
#include "rave/sim/obstacle_history.hpp"
#include "rave/sim/world_authority.hpp"
#include "world_truth.hpp"

namespace rave::sim {

struct WorldAuthority::Impl {
  Impl(EngineSpec s, std::vector<std::uint32_t> hosts);

  void begin();
  [[nodiscard]] Status check(const HostReport& report) const;
  [[nodiscard]] Status check(std::span<const HostReport* const> reports);
  void finish_step();
  void put_refusal_texts(std::uint64_t in_step);
  void make_changes(WorldStep& world);
  void take_inputs(WorldStep& world);
  Status check_and_do(WorldInput& input, WorldStep& world);
  Status do_input(WorldInput& input, WorldStep& world);
  Status change_body(RobotId robot, std::span<const ParameterChange> changes, const Author& author,
                     WorldStep& world);
  Status change_obstacle(const ObstacleChange& change, const Author& author, WorldStep& world);
  Status place(const WorldInput& input, const request::Place& there);
  void make_obstacle_changes(WorldStep& world);
  void conduct(WorldStep& world);
  void refuse(RobotId robot, const Error& why);
  void take_over_obstacles(WorldStep& world);
  void close_obstacles();
  void place_real_robots();
  void write_poses(WorldStep& world) const;
  void write_contacts(WorldStep& world);
  void write_messages(WorldStep& world);

  EngineSpec spec;
  std::vector<std::uint32_t> host_of;  ///< By robot.
  std::vector<HostRobots> hosts;
  std::vector<const HostReport*> by_host;  ///< During step() alone.
  ThreadPool pool;
  WorldTruth truth;
  std::uint64_t step = 0;     ///< The world of this one comes next.
  std::vector<Event> events;  ///< So far, of the step that the hosts are in.
  RunHash hash;
  // Of the steps that are done:
  std::vector<Event> done_events;
  RunHash done_hash;
  std::vector<WorldInput> asked;  ///< For the next step.
  Conducted conducted;            ///< In the step that was made last.
  std::uint64_t inputs = 0;
  std::size_t next_change = 0;
  std::size_t next_obstacle = 0;               ///< Of spec.obstacle_changes.
  ObstacleHistory history;                     ///< Before the world that was made last.
  std::vector<ObstacleChange> last_obstacles;  ///< Of that world.
  std::vector<ObstacleChange> adopted;         ///< Of another authority, for the next step.
  std::vector<InputRefusal> refusals;
  std::uint64_t refused_count = 0;  ///< Changes of the scenario, in all steps.
  std::vector<Event> refused;       ///< The first of them.
  std::vector<std::pair<const SentPacket*, const SentPackets*>> sent;  ///< During step() alone.
  std::vector<std::uint32_t> seen;  ///< Robots that were pushed, with repetition.
};

}  // namespace rave::sim
