// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "host_connection.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/host_link.hpp"
#include "rave/protocol/live_messages.hpp"
#include "rave/protocol/shared_time.hpp"

namespace rave::real_time {

/// The clock of this process.
[[nodiscard]] inline std::int64_t local_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// The state of a link; host_link_hear.cpp handles what arrives on the bus, host_link.cpp the rest.
/// `begun`: the run has started.
struct HostLink::Impl final : lock_step::HostConnection {
  Options options;
  LiveWorld& live;
  // For a managed run.
  std::optional<bus::Writer<bus::ClockPing>> pings{};
  std::optional<bus::Reader<bus::ClockPong>> pongs{};
  std::optional<bus::Reader<bus::Obstacle>> obstacles{};  ///< Created anew for each manager.
  std::optional<bus::Writer<bus::LastObstacle>> last_obstacles{};
  std::optional<bus::Reader<bus::World>> worlds{};        // If a robot here sees others.
  std::optional<bus::Writer<bus::Packet>> packets_out{};  // If a robot here communicates.
  std::optional<bus::Reader<bus::Packet>> packets_in{};
  std::optional<Realities> realities{};  // If drivers may change.
  bus::WaitSet waits{};                  // Declared after everything that it waits for.
  // For monitors.
  lock_step::Pulse::Facts facts{};
  std::uint64_t last_world_number = 0;  ///< From this manager; 0: none yet.

  SharedTime time{};
  std::vector<bus::HostInfo> managers{};  ///< The managers present; the first one is obeyed.
  /// The start of the run by the clock of this process; fixed once the run has started.
  std::int64_t zero_ns = 0;
  std::uint64_t pings_sent = 0;         ///< To this manager.
  std::uint64_t pongs_heard = 0;        ///< From this manager.
  std::uint64_t obstacle_revision = 0;  ///< The revision that the manager announces.
  bool wrong_obstacles = false;         ///< The manager has sent invalid obstacles.
  std::uint64_t shown_revision = 0;     ///< The revision of the obstacles that the robots here see,
  SimTime shown_since{};                ///< and the run time since which they see it.
  Clock::time_point ping_at{};
  std::vector<RobotSight> starts{};
  std::uint64_t world_count = 0;
  std::uint64_t losses = 0;
  bool world_lost = false;
  Clock::time_point last_world{};
  std::uint64_t packets_sent = 0;
  std::map<RobotId, TalkLimit> talk{};  ///< For the robots here that have sent packets.
  std::vector<RobotId> flooders{};
  std::uint64_t packets_withheld = 0;
  std::uint64_t packets_unsent = 0;
  std::map<std::uint64_t, std::uint64_t> packets_heard{};  ///< The newest number by process.
  std::uint64_t packets_lost = 0;

  Impl(Options its, LiveWorld& world)
      : HostConnection(its.self, its.log, its.managed), options(std::move(its)), live(world) {}
  Status open();
  bool serves() const override { return begun; }
  void meet_manager(const bus::HostInfo& info) override;
  void hear(const lock_step::RunWord& word) override;
  void lose(std::uint64_t writer) override;
  /// Added to a stamp of this process to convert it to run time.
  [[nodiscard]] Duration shift() const noexcept { return {begun ? zero_ns - time.zero_ns() : 0}; }
  void take();
  void take_pongs();
  void take_worlds();
  void take_obstacles();
  void hear(const bus::Obstacle& sample);
  void take_packets();
  void note_number(const bus::Packet& packet);
  void tell_word();
  void listen_to_first();
  void ping();
  void start_clock();
  [[nodiscard]] bool ready() const;
  [[nodiscard]] Duration patience() const noexcept;
  void watch_worlds();
};

}  // namespace rave::real_time
