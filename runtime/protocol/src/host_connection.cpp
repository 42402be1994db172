// SPDX-License-Identifier: Apache-2.0
#include "host_connection.hpp"

#include <algorithm>

#include "rave/bus/sequence.hpp"
#include "rave/bus/standstill.hpp"

namespace rave::lock_step {

Status HostConnection::open(const bus::BusConfig& config, bus::BeginRequest begin_request,
                            bus::BeginCommand begin_command) {
  RAVE_TRY_ASSIGN(bus, bus::Bus::open(config));
  RAVE_TRY(bus::open_all(*bus, own_info, infos, states));
  if (managed) RAVE_TRY(bus::open_all(*bus, runs, host_results));
  RAVE_TRY(roster.open(*bus, self.host));
  RAVE_TRY(pulse.open(*bus, self));
  RAVE_TRY(host_word.open(*bus, self.host, self.name));
  RAVE_TRY_ASSIGN(requests, bus::RequestBox::create(*bus, std::move(begin_request), log));
  RAVE_TRY_ASSIGN(commands, bus::CommandBox::create(*bus, std::move(begin_command), log));
  return {};
}

Status HostConnection::join(bus::WaitSet& waits) {
  RAVE_TRY(waits.add(infos));
  if (managed) RAVE_TRY(waits.add(runs));
  // These wake the wait as well, so a stop that arrives between two steps is handled at once.
  if (requests) RAVE_TRY(requests->wake(waits));
  if (commands) RAVE_TRY(commands->wake(waits));
  RAVE_TRY(waits.add_events());
  introduced = introduction(self);
  return own_info.write(introduced);
}

void HostConnection::tell(LogLevel level, const std::string& text) const {
  if (log != nullptr) log->write(level, "host " + self.name, text);
}

void HostConnection::tell_once(LogLevel level, const std::string& text) {
  if (text == told) return;
  told = text;
  if (!text.empty()) tell(level, text);
}

void HostConnection::tell_foreign(LogLevel level, const std::string& text) {
  if (text == told) return;
  told = text;
  if (!text.empty()) foreign.write(level, "host " + self.name, text);
}

void HostConnection::tell_manager(const bus::HostInfo& info) {
  host_word.place_manager(info.machine, info.folder);
  tell_once(LogLevel::kInfo, fmt::format("the environment manager is `{}` on {}", info.name,
                                         *info.machine != '\0' ? info.machine : "this machine"));
}

void HostConnection::serve() {
  if (requests) requests->serve();
  if (commands) commands->serve();
}

void HostConnection::meet(const bus::HostInfo& info) {
  if (info.host == rave_wire_kNone) {
    // An introduction without a host number is that of a manager.
    if (!managed) return;
    if (auto fits = check_fits(self, info); !fits) {
      // A manager of another scenario must not end this run by its words.
      words.shut_out(info.writer);
      if (begun) return tell_foreign(LogLevel::kError, "refused: " + fits.error().message);
      unfit = std::move(fits).error();
      return;
    }
    words.welcome(info.writer);
    return meet_manager(info);
  }
  // A process that is part of the run already stays.
  if (info.host != self.host || serves() || !gives_way(introduced, info)) return;
  unfit = Error{ErrorCode::kState,
                fmt::format("host `{}` of this run is served already, by a process on {}; end that "
                            "one first, or choose another host",
                            self.name, *info.machine != '\0' ? info.machine : "this machine"),
                {}};
}

void HostConnection::look() {
  using enum bus::EventKind;
  // Events come before messages: a process that returned must count as present when its messages
  // are read, and the last words of one that left must have been read before its loss counts.
  const std::vector<bus::BusEvent> events = bus->take_events();
  for (const bus::BusEvent& event : events) {
    if (event.kind == kParticipantAppeared) appear(event.writer);
  }
  // Introductions come before the states of the run, because a state counts only if its manager is
  // known to be of this run.
  infos.take([this](const bus::HostInfo& info) { meet(info); });
  if (managed) {
    runs.take([this](const bus::RunState& state) { words.hear(run_word(state, self.host)); });
  }
  for (const RunWord& word : words.take()) hear(word);
  for (const bus::BusEvent& event : events) {
    if (event.kind == kParticipantLost && event.writer != 0) lose(event.writer);
    if (event.kind == kParticipantAppeared) appear(event.writer);
    foreign.note(event);
  }
}

void HostConnection::look_at_patience(Duration longest, const char* why) {
  if (!managed || ending || longest.ns <= 0 || manager != 0) return;
  const auto now = Clock::now();
  const auto since = std::max(alone_since, bus->standstill().silence_counts_from());
  if (now - since < std::chrono::nanoseconds(longest.ns)) return;
  ending = RunEnding{
      false, fmt::format("there was no environment manager for {:g} s{}", longest.seconds(), why)};
  tell_once(LogLevel::kError, "gives up: " + ending->text);
}

void HostConnection::publish(const sim::Engine& engine, std::span<const RobotId> robots,
                             bool reports, Duration shift) {
  columns.clear();
  reports_out.clear();
  for (const RobotId robot : robots) {
    columns.add(engine, robot, shift);
    if (reports) reports_out.add(engine, robot);
  }
  if (columns.size() == 0 && (robots.empty() || !reports)) return;
  bus::HostState message{};
  message.host = self.host;
  message.step = engine.steps_done();
  columns.lend(message.resolved);
  reports_out.lend(message.reports);
  // A reader that is too slow misses some messages.
  static_cast<void>(states.write(message));
}

Status HostConnection::deliver(std::span<const std::byte> results, std::uint64_t step) {
  if (!begun) return {};
  // Monitors learn the end from the host itself, because a run may have no manager, and a GUI
  // Server does not hear it.
  host_word.tell_end(!ending || ending->good, step, ending ? ending->text : "");
  return managed ? host_results.send(self.host, results, kHostResultsPatience) : Status();
}

}  // namespace rave::lock_step
