// SPDX-License-Identifier: Apache-2.0
// What a host in lock-step learns of the other processes of its run.
#include <algorithm>

#include "host_port_impl.hpp"
#include "rave/bus/standstill.hpp"

namespace rave::lock_step {
namespace {

/// After this process was suspended, a process that is not rediscovered within this time counts as
/// lost.
constexpr std::chrono::seconds kMissedAtOnce{1};
/// At most this many lost processes are remembered.
constexpr std::size_t kMostGone = 4096;

}  // namespace

/// Logs a text once, until a different text follows.
void HostPort::Impl::tell(LogLevel level, const std::string& text) {
  if (text == told) return;
  told = text;
  if (log != nullptr && !text.empty()) log->write(level, "host " + self.name, text);
}

/// The same for texts caused by other processes.
void HostPort::Impl::tell_foreign(LogLevel level, const std::string& text) {
  if (text == told) return;
  told = text;
  if (!text.empty()) foreign.write(level, "host " + self.name, text);
}

void HostPort::Impl::meet(const bus::HostInfo& info) {
  if (info.host == rave_wire_kNone) {
    if (auto fits = check_fits(self, info); !fits) {
      words.shut_out(info.writer);
      if (has_world) {
        return tell_foreign(LogLevel::kError, "refused: " + fits.error().message);
      }
      unfit = std::move(fits).error();
      return;
    }
    words.welcome(info.writer);
    // A further manager is accepted only after the loss of the current one.
    if (manager != 0 || gone.contains(info.writer)) return;
    manager = info.writer;
    host_word->place_manager(info.machine, info.folder);
    tell(LogLevel::kInfo, fmt::format("the environment manager is `{}` on {}", info.name,
                                      *info.machine != '\0' ? info.machine : "this machine"));
    return;
  }
  // A process that is part of the run already stays.
  if (info.host != self.host || epoch != 0 || !gives_way(introduced, info)) return;
  unfit = Error{ErrorCode::kState,
                fmt::format("host `{}` of this run is served already, by a process on {}; end that "
                            "one first, or choose another host",
                            self.name, *info.machine != '\0' ? info.machine : "this machine"),
                {}};
}

void HostPort::Impl::hear(const RunWord& word) {
  // The last state that a manager announced before its loss still counts, but does not make it
  // present again.
  if (manager == 0 && !gone.contains(word.writer)) manager = word.writer;
  if (manager != 0 && word.writer != manager) return;
  if (word.without_us) {
    over = true;
    ending = {false, "the run continued without this host, which was late or lost"};
  }
  switch (word.phase) {
    case rave_wire_RUN_GOES:
      told.clear();
      return;
    case rave_wire_RUN_GATHERS:
    case rave_wire_RUN_WAITS:
      tell_foreign(LogLevel::kWarning, word.text);
      return;
    case rave_wire_RUN_ENDED:
    case rave_wire_RUN_FAILED:
      over = true;
      ending = {word.phase == rave_wire_RUN_ENDED, word.text};
      return;
  }
}

void HostPort::Impl::lose(std::uint64_t writer) {
  if (writer == 0) return;
  if (gone.size() >= kMostGone) gone.erase(gone.begin());
  gone.insert(writer);
  if (writer != manager) return;
  manager = 0;
  epoch = 0;
  alone_since = Clock::now();
  // A manager that is not rediscovered counts as lost as soon as its lease has expired. Its lease
  // began when it was last heard, some time before this process was suspended.
  const bus::Standstill& still = bus->standstill();
  overslept = 2 * still.stood().ns > bus->config().lease.ns &&
              alone_since - still.silence_counts_from() < kMissedAtOnce;
  if (over) return;
  tell(LogLevel::kError, "the environment manager is lost; robots stop until one is back");
}

void HostPort::Impl::look_at_processes() {
  using enum bus::EventKind;
  // Events come before messages: a process that returned must count as present when its messages
  // are read, and one that left was read before.
  const std::vector<bus::BusEvent> events = bus->take_events();
  for (const bus::BusEvent& event : events) {
    if (event.kind == kParticipantAppeared) gone.erase(event.writer);
  }
  infos.take([this](const bus::HostInfo& info) { meet(info); });
  states.take([this](const bus::RunState& state) { words.hear(run_word(state, self.host)); });
  for (const RunWord& word : words.take()) hear(word);
  for (const bus::BusEvent& event : events) {
    if (event.kind == kParticipantLost) lose(event.writer);
    if (event.kind == kParticipantAppeared) gone.erase(event.writer);
    foreign.note(event);
  }
}

/// A process started for a run that no longer exists must not wait forever.
void HostPort::Impl::look_at_patience() {
  const bool short_of_it = overslept && patience.after_standstill.ns > 0;
  const Duration longest = short_of_it ? patience.after_standstill : patience.usual;
  if (over || longest.ns <= 0 || manager != 0) return;
  const auto since = std::max(alone_since, bus->standstill().silence_counts_from());
  if (Clock::now() - since < std::chrono::nanoseconds(longest.ns)) return;
  over = true;
  ending = {
      false,
      fmt::format("there was no environment manager for {} s{}", longest.seconds(),
                  short_of_it ? " after this host stood still: the run continued without it" : "")};
  tell(LogLevel::kError, fmt::format("gives up: {}", ending.text));
}

}  // namespace rave::lock_step
