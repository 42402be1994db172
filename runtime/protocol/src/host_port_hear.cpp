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

void HostPort::Impl::meet_manager(const bus::HostInfo& info) {
  // A further manager is accepted only after the loss of the current one.
  if (manager != 0 || gone.contains(info.writer)) return;
  manager = info.writer;
  tell_manager(info);
}

void HostPort::Impl::hear(const RunWord& word) {
  // The last state that a manager announced before its loss still counts, but does not make it
  // present again.
  if (manager == 0 && !gone.contains(word.writer)) manager = word.writer;
  if (manager != 0 && word.writer != manager) return;
  if (word.without_us) {
    ending = RunEnding{false, "the run continued without this host, which was late or lost"};
    return;
  }
  switch (word.phase) {
    case rave_wire_RUN_RUNNING:
      told.clear();
      return;
    case rave_wire_RUN_GATHERING:
    case rave_wire_RUN_WAITS:
      tell_foreign(LogLevel::kWarning, word.text);
      return;
    case rave_wire_RUN_ENDED:
    case rave_wire_RUN_FAILED:
      ending = RunEnding{word.phase == rave_wire_RUN_ENDED, word.text};
      return;
  }
}

void HostPort::Impl::lose(std::uint64_t writer) {
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
  if (ending) return;
  tell_once(LogLevel::kError, "the environment manager is lost; robots stop until one is back");
}

void HostPort::Impl::look_at_patience() {
  const bool short_of_it = overslept && patience.after_standstill.ns > 0;
  HostConnection::look_at_patience(
      short_of_it ? patience.after_standstill : patience.usual,
      short_of_it ? " after this host stood still: the run continued without it" : "");
}

}  // namespace rave::lock_step
