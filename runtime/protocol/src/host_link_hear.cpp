// SPDX-License-Identifier: Apache-2.0
// What a host takes from the bus.
#include <algorithm>
#include <cstdlib>

#include "host_link_impl.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/standstill.hpp"

namespace rave::real_time {
namespace {

/// Packets of at most this many processes are counted.
constexpr std::size_t kMostProcesses = 4096;
/// Better readings of the same clock change the estimate by less.
constexpr std::int64_t kJump_ns = 1'000'000;

}  // namespace

void HostLink::Impl::meet(const bus::HostInfo& info) {
  const char* const machine = *info.machine != '\0' ? info.machine : "this machine";
  if (info.host == rave_wire_kNone) {
    // An introduction without a host number is that of a manager.
    if (!options.managed) return;
    if (auto fits = lock_step::check_fits(options.self, info); !fits) {
      // A manager of another scenario must not end this run by its words.
      words.shut_out(info.writer);
      if (started) tell_foreign(LogLevel::kError, "refused: " + fits.error().message);
      // Before the start this ends await_start(). Afterwards nobody reads it, and the run
      // continues.
      unfit = std::move(fits).error();
      return;
    }
    words.welcome(info.writer);
    const auto same = [&](const auto& known) { return known.writer == info.writer; };
    if (std::any_of(managers.begin(), managers.end(), same)) return;
    managers.push_back(info);
    // A second manager is only remembered: this host listens to the first until that one is lost.
    if (managers.size() == 1) listen_to_first();
    return;
  }
  // A process that is part of the run already stays.
  if (info.host != options.self.host || started || !lock_step::gives_way(introduced, info)) return;
  unfit = Error{ErrorCode::kState,
                fmt::format("host `{}` of this run is served already, by a process on {}; end that "
                            "one first, or choose another host",
                            options.self.name, machine),
                {}};
}

void HostLink::Impl::take_infos() {
  infos.take([this](const bus::HostInfo& info) { meet(info); });
}

void HostLink::Impl::take_pongs() {
  const std::int64_t heard_ns = local_ns();
  pongs->take([&](const bus::ClockPong& pong) {
    if (pong.target != bus->writer() || pong.writer != manager) return;
    const std::int64_t before = time.known() ? time.zero_ns() : 0;
    const bool was_known = time.known();
    const Status heard = time.hear(
        pong.writer, {pong.ping_sent_ns, pong.ping_received_ns, pong.pong_sent_ns, heard_ns},
        pong.begun, pong.zero_ns);
    if (!heard) {
      pongs->refuse(pong, heard.error().message);
    } else {
      // Without the time that the manager needed between receiving and answering.
      facts.round_trip_ns =
          heard_ns - pong.ping_sent_ns - (pong.pong_sent_ns - pong.ping_received_ns);
    }
    ++pongs_heard;
    obstacle_revision = pong.obstacle_revision;
    // The clock of a new manager may differ slightly, and stamps must not seem to stand still.
    if (was_known && std::abs(before - time.zero_ns()) > kJump_ns) live.clock_changed();
  });
}

void HostLink::Impl::take_worlds() {
  worlds->take([this](const bus::World& world) {
    if (world.writer != manager) return;
    ++world_count;
    // Worlds are numbered from 1, so a gap is the number of lost ones. After a change of the
    // manager the count begins anew.
    if (last_world_number != 0 && world.step > last_world_number) {
      facts.missed += world.step - last_world_number - 1;
    }
    last_world_number = world.step;
    last_world = Clock::now();
    // Stamps on the wire are in the time of the run, those of the engine in the time of this host.
    const Duration back{-shift().ns};
    for (std::size_t i = 0; i < world.robots.id._length; ++i) {
      const RobotSight sight = read_robot(world.robots, i, back);
      // LiveWorld refuses robots of this host. Before the start they show where an earlier process
      // of this host left them, and where they begin again.
      if (!live.see(sight) && !started) {
        std::erase_if(starts, [&](const auto& start) { return start.robot == sight.robot; });
        starts.push_back(sight);
      }
    }
  });
}

/// Each process numbers its packets, so a gap in the numbers means lost packets.
void HostLink::Impl::note_number(const bus::Packet& packet) {
  // Forgetting costs the count of one gap; an unbounded table could be filled by invented writers.
  if (packets_heard.size() >= kMostProcesses) packets_heard.clear();
  std::uint64_t& newest = packets_heard[packet.writer];
  if (newest != 0 && packet.number > newest + 1) packets_lost += packet.number - newest - 1;
  newest = std::max(newest, packet.number);
}

void HostLink::Impl::take_obstacles() {
  // Read everything that has arrived before a step: of two changes, the later one may come first.
  while (obstacles->take([this](const bus::Obstacle& sample) { hear(sample); }) > 0) continue;
}

void HostLink::Impl::hear(const bus::Obstacle& sample) {
  if (sample.writer != manager) return;
  auto sight = read_obstacle(sample);
  if (!sight) {
    obstacles->refuse(sample, sight.error().message);
    return;
  }
  if (const Status possible = live.check(*sight); !possible) {
    // Logged once per manager, because many invalid changes may follow.
    if (!std::exchange(wrong_obstacles, true)) {
      tell(LogLevel::kWarning, "refused from the environment manager: " + possible.error().message);
    }
    return;
  }
  if (!live.see(*std::move(sight))) return;
  // Kept for a manager that replaces this one.
  bus::LastObstacle kept{};
  static_cast<bus::Obstacle&>(kept) = sample;
  if (auto written = last_obstacles->write(kept); !written) {
    tell(LogLevel::kWarning,
         "an obstacle cannot be kept for another manager: " + written.error().message);
  }
}

void HostLink::Impl::take_packets() {
  packets_in->take([this](const bus::Packet& packet) {
    note_number(packet);
    sim::SentPacket sent = read_packet(packet, Duration{-shift().ns});
    // The clocks are unrelated, so the time of reception counts as the time of sending.
    if (!options.managed) sent.stamp_ns = INT64_MAX;
    live.hear(packet.writer, sent, payload_of(packet));
  });
}

void HostLink::Impl::hear(const lock_step::RunWord& word) {
  if (manager != 0 && word.writer != manager) return;
  switch (word.phase) {
    case rave_wire_RUN_GOES:
      return;
    case rave_wire_RUN_GATHERS:
    case rave_wire_RUN_WAITS:
      if (!started) tell_foreign(LogLevel::kWarning, word.text);
      return;
    case rave_wire_RUN_ENDED:
    case rave_wire_RUN_FAILED:
      ending = Ending{word.phase == rave_wire_RUN_ENDED, word.text};
      return;
  }
}

void HostLink::Impl::listen_to_first() {
  manager = managers.front().writer;
  pings_sent = 0;
  pongs_heard = 0;
  last_world_number = 0;
  wrong_obstacles = false;
  ping_at = {};
  // A new reader receives all obstacles, also those published before this process listened to this
  // manager.
  obstacles.reset();
  if (auto made = make(obstacles, *bus); !made) unfit = std::move(made).error();
  const char* const machine = managers.front().machine;
  host_word->place_manager(machine, managers.front().folder);
  tell_once(LogLevel::kInfo,
            fmt::format("the environment manager is `{}` on {}", managers.front().name,
                        *machine != '\0' ? machine : "this machine"));
}

void HostLink::Impl::lose(std::uint64_t writer) {
  std::erase_if(managers, [&](const auto& info) { return info.writer == writer; });
  if (writer != manager) return;
  manager = 0;
  alone_since = Clock::now();
  if (!ending) {
    tell_once(LogLevel::kError, started ? "the environment manager is lost; this host continues "
                                          "without the others until one is back"
                                        : "the environment manager is lost");
  }
  // The next manager may have appeared before the loss of this one was detected.
  if (!managers.empty()) listen_to_first();
}

/// A process started for a run that no longer exists must not wait forever for its beginning.
void HostLink::Impl::look_at_patience() {
  const Duration longest = options.manager_patience;
  if (!options.managed || ending || longest.ns <= 0 || manager != 0) return;
  const auto since = std::max(alone_since, bus->standstill().silence_counts_from());
  if (Clock::now() - since < std::chrono::nanoseconds(longest.ns)) return;
  ending =
      Ending{false, fmt::format("there was no environment manager for {} s", longest.seconds())};
  tell(LogLevel::kError, "gives up: " + ending->text);
}

/// Work that can wait until nothing else is due.
/// Introductions come before the states of the run, because a state counts only if its manager is
/// known to be of this run. Losses come last, so that the last words of a lost process still count.
void HostLink::Impl::look() {
  take_infos();
  if (runs) {
    runs->take([this](const bus::RunState& state) {
      words.hear(lock_step::run_word(state, options.self.host));
    });
  }
  for (const lock_step::RunWord& word : words.take()) hear(word);
  for (const bus::BusEvent& event : bus->take_events()) {
    using enum bus::EventKind;
    if (event.kind == kParticipantLost && event.writer != 0) {
      if (realities) realities->lose(event.writer);
      lose(event.writer);
      continue;
    }
    foreign.note(event);
  }
}

/// For monitors.
void HostLink::Impl::tell_word() {
  lock_step::HostWord::Facts said{rave_wire_RUN_GOES, facts.step, ""};
  said.managed = options.managed;
  said.manager_here = manager != 0;
  if (!started) {
    said.phase = rave_wire_RUN_GATHERS;
    said.text = told;
  }
  host_word->tell(said);
}

void HostLink::Impl::take() {
  // The order: first what must not be late (the pulse, clock answers, whose reception is stamped),
  // then data for the next step. Obstacles come last, because look() may change the manager and
  // with it their reader.
  pulse->beat(facts);
  tell_word();
  if (pongs) take_pongs();
  if (worlds) take_worlds();
  if (packets_in) take_packets();
  if (realities) realities->hear();
  if (requests) requests->serve();
  if (commands) commands->serve();
  look();
  if (obstacles) take_obstacles();
}

}  // namespace rave::real_time
