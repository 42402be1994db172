// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rave/bus/event_log.hpp"
#include "rave/bus/request_box.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/host_link.hpp"
#include "rave/protocol/host_results.hpp"
#include "rave/protocol/live_messages.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/run_words.hpp"
#include "rave/protocol/shared_time.hpp"

namespace rave::real_time {

/// The clock of this process.
[[nodiscard]] inline std::int64_t local_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// Creates a writer or reader that only some runs need.
template <class End, class... More>
Status make(std::optional<End>& place, bus::Bus& bus, const More&... more) {
  RAVE_TRY_ASSIGN(End end, End::create(bus, more...));
  place.emplace(std::move(end));
  return {};
}

/// The state of a link; host_link_hear.cpp handles what arrives on the bus, host_link.cpp the rest.
struct HostLink::Impl {
  using Clock = std::chrono::steady_clock;

  Options options;
  LiveWorld& live;
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::HostInfo> own_info;
  bus::Reader<bus::HostInfo> infos;
  bus::Writer<bus::HostState> states;
  lock_step::Roster roster;
  bus::EventLog foreign{options.log};  ///< For messages caused by other processes.
  bus::HostInfo introduced{};          ///< What this process published about itself.
  // For a managed run.
  std::optional<bus::Writer<bus::ClockPing>> pings{};
  std::optional<bus::Reader<bus::ClockPong>> pongs{};
  std::optional<bus::Reader<bus::RunState>> runs{};
  std::optional<bus::Reader<bus::Obstacle>> obstacles{};  ///< Created anew for each manager.
  std::optional<bus::Writer<bus::LastObstacle>> last_obstacles{};
  std::optional<lock_step::HostResultsSender> host_results{};
  std::optional<bus::Reader<bus::World>> worlds{};        // If a robot here sees others.
  std::optional<bus::Writer<bus::Packet>> packets_out{};  // If a robot here communicates.
  std::optional<bus::Reader<bus::Packet>> packets_in{};
  std::optional<Realities> realities{};         // If drivers may change.
  std::unique_ptr<bus::RequestBox> requests{};  // If other processes may send requests.
  std::unique_ptr<bus::CommandBox> commands{};
  std::optional<bus::WaitSet> waits{};  // Declared after everything that it waits for.
  std::optional<lock_step::Pulse> pulse{};
  // For monitors.
  lock_step::Pulse::Facts facts{};
  std::optional<lock_step::HostWord> host_word{};
  std::uint64_t last_world_number = 0;  ///< From this manager; 0: none yet.

  SharedTime time{};
  std::vector<bus::HostInfo> managers{};         ///< The managers present; the first one is obeyed.
  std::uint64_t manager = 0;                     ///< The process of the manager; 0: none.
  lock_step::RunWords words{};                   ///< The announced states of the run, by process.
  Clock::time_point alone_since = Clock::now();  ///< Valid while there is no manager.
  std::optional<Error> unfit{};
  std::optional<Ending> ending{};
  std::string told{};
  bool started = false;
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
  RobotColumns columns{};
  lock_step::ReportColumns reports{};
  std::uint64_t packets_sent = 0;
  std::map<RobotId, TalkLimit> talk{};  ///< For the robots here that have sent packets.
  std::vector<RobotId> flooders{};
  std::uint64_t packets_withheld = 0;
  std::uint64_t packets_unsent = 0;
  std::map<std::uint64_t, std::uint64_t> packets_heard{};  ///< The newest number by process.
  std::uint64_t packets_lost = 0;

  Status open_endpoints();
  void tell(LogLevel level, const std::string& text) const;
  void tell_once(LogLevel level, const std::string& text);
  void tell_foreign(LogLevel level, const std::string& text);
  /// Added to a stamp of this process to convert it to run time.
  [[nodiscard]] Duration shift() const noexcept { return {started ? zero_ns - time.zero_ns() : 0}; }
  void take();
  void take_infos();
  void meet(const bus::HostInfo& info);
  void take_pongs();
  void take_worlds();
  void take_obstacles();
  void hear(const bus::Obstacle& sample);
  void take_packets();
  void note_number(const bus::Packet& packet);
  void hear(const lock_step::RunWord& word);
  void look_at_patience();
  void tell_word();
  void look();
  void listen_to_first();
  void lose(std::uint64_t writer);
  void ping();
  void start_clock();
  [[nodiscard]] bool ready() const;
  [[nodiscard]] Duration patience() const noexcept;
  void watch_worlds();
};

}  // namespace rave::real_time
