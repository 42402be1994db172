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
#include "rave/bus/wait_set.hpp"
#include "rave/bus/wish_box.hpp"
#include "rave/bus/writer.hpp"
#include "rave/protocol/findings.hpp"
#include "rave/protocol/host_link.hpp"
#include "rave/protocol/live_messages.hpp"
#include "rave/protocol/pulse.hpp"
#include "rave/protocol/run_words.hpp"
#include "rave/protocol/shared_time.hpp"

namespace rave::real_time {

/// By the clock of this process.
[[nodiscard]] inline std::int64_t local_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// A writer or reader that is not always there.
template <class End, class... More>
Status make(std::optional<End>& place, bus::Bus& bus, const More&... more) {
  RAVE_TRY_ASSIGN(End end, End::create(bus, more...));
  place.emplace(std::move(end));
  return {};
}

/// All of a link; host_link_hear.cpp is what it takes from the bus, host_link.cpp the rest.
struct HostLink::Impl {
  using Clock = std::chrono::steady_clock;

  Options options;
  LiveWorld& live;
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::HostInfo> own_info;
  bus::Reader<bus::HostInfo> infos;
  bus::Writer<bus::HostState> states;
  lock_step::Roster roster;
  bus::EventLog foreign{options.log};  ///< What others have caused.
  bus::HostInfo introduced{};          ///< What the others were told of this process.
  // Of a managed run.
  std::optional<bus::Writer<bus::ClockPing>> pings{};
  std::optional<bus::Reader<bus::ClockPong>> pongs{};
  std::optional<bus::Reader<bus::RunState>> runs{};
  std::optional<bus::Reader<bus::Obstacle>> obstacles{};  ///< Made anew for each manager.
  std::optional<bus::Writer<bus::LastObstacle>> last_obstacles{};
  std::optional<lock_step::FindingsSender> findings{};
  std::optional<bus::Reader<bus::World>> worlds{};        // if it sees
  std::optional<bus::Writer<bus::Packet>> packets_out{};  // if it talks
  std::optional<bus::Reader<bus::Packet>> packets_in{};
  std::optional<Realities> realities{};    // if drivers may change
  std::unique_ptr<bus::WishBox> wishes{};  // if others may ask
  std::unique_ptr<bus::CommandBox> commands{};
  std::optional<bus::WaitSet> waits{};  // behind all that it waits for
  std::optional<lock_step::Pulse> pulse{};
  lock_step::Pulse::Facts facts{};      ///< For those who look on.
  std::uint64_t last_world_number = 0;  ///< Of this manager; 0: none yet.

  SharedTime time{};
  std::vector<bus::HostInfo> managers{};         ///< That are there; the first is listened to.
  std::uint64_t manager = 0;                     ///< Its process; 0: nobody.
  lock_step::RunWords words{};                   ///< What is said of the run, and by whom.
  Clock::time_point alone_since = Clock::now();  ///< While there is no manager.
  std::optional<Error> unfit{};
  std::optional<Ending> ending{};
  std::string told{};
  bool started = false;
  std::int64_t zero_ns = 0;             ///< Of this process; stands once it has started.
  std::uint64_t pings_sent = 0;         ///< To this manager.
  std::uint64_t pongs_heard = 0;        ///< From it.
  std::uint64_t obstacle_revision = 0;  ///< That it says there is.
  bool wrong_obstacles = false;         ///< It has told of some that cannot be.
  std::uint64_t shown_revision = 0;     ///< That the robots here have around them,
  SimTime shown_since{};                ///< by the time of the run.
  Clock::time_point ping_at{};
  std::vector<RobotSight> starts{};
  std::uint64_t world_count = 0;
  std::uint64_t losses = 0;
  bool world_lost = false;
  Clock::time_point last_world{};
  RobotColumns columns{};
  std::uint64_t packets_sent = 0;
  std::map<RobotId, TalkLimit> talk{};  ///< Of robots here that have said something.
  std::vector<RobotId> flooders{};
  std::uint64_t packets_withheld = 0;
  std::uint64_t packets_unsent = 0;
  std::map<std::uint64_t, std::uint64_t> packets_heard{};  ///< By process: the newest number.
  std::uint64_t packets_lost = 0;

  Status open_endpoints();
  void tell(LogLevel level, const std::string& text) const;
  void tell_once(LogLevel level, const std::string& text);
  void tell_foreign(LogLevel level, const std::string& text);
  /// What is put on a stamp of this process to make it one of the run.
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
