// SPDX-License-Identifier: Apache-2.0
// Waits for DDS and for sockets at once. A thread of its own waits for DDS and writes to a
// descriptor, which the owner polls together with its sockets.
#include "relay.hpp"

#include <poll.h>
#include <sched.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <utility>

#include "rave/base/thread.hpp"
#include "rave/bus/local_transport.hpp"
#include "rave/bus/wait_set.hpp"

namespace rave::bus {
namespace {

/// About twice the time to wake a sleeping process.
constexpr Duration kAwake{20'000};
/// If yielding took this long, the processor is used by a process that does not wait for messages.
constexpr std::chrono::milliseconds kLongAway{1};
/// Time without spinning after that; doubles if it happens again soon.
constexpr std::chrono::milliseconds kCrowded{20};
constexpr std::chrono::milliseconds kMostCrowded{1000};

}  // namespace

Result<std::unique_ptr<Relay>> Relay::create(dds_entity_t set, dds_entity_t bell) {
  Bell event;
  if (event.descriptor() < 0)
    return fail(ErrorCode::kIo, "cannot wait: no event descriptor is available");
  std::unique_ptr<Relay> relay(new Relay(set, bell, std::move(event)));
  RAVE_TRY(start_thread(relay->thread_, "a wait set", [it = relay.get()] { it->run(); }));
  return relay;
}

Relay::~Relay() {
  over_ = true;
  // The thread is in one of two places: it waits for a request, or in the wait set. Both must be
  // ended.
  ask_.release();
  dds_set_guardcondition(bell_, true);
  if (thread_.joinable()) thread_.join();
}

void Relay::run() noexcept {
  for (;;) {
    ask_.acquire();
    if (over_) return;
    std::array<dds_attach_t, 1> woken{};
    static_cast<void>(dds_waitset_wait(set_, woken.data(), woken.size(), DDS_INFINITY));
    // The thread waits for the next request: the condition in the set persists until a sample is
    // taken.
    answered_ = true;
    event_.ring();
  }
}

bool Relay::ready() const {
  std::array<dds_attach_t, 1> woken{};
  if (dds_waitset_wait(set_, woken.data(), woken.size(), 0) <= 0) return false;
  tell_of_dds();
  return true;
}

void Relay::add(LocalReceiver& receiver) {
  polled_.push_back({receiver.descriptor(), POLLIN, 0});
  receivers_.push_back(&receiver);
}

void Relay::tell_of_dds() const {
  for (LocalReceiver* const receiver : receivers_) receiver->note_dds();
}

void Relay::note_answer() {
  if (!answered_.exchange(false)) return;
  asked_ = false;
  tell_of_dds();
}

/// An answer often arrives sooner than it takes to sleep and wake up, so spin first. Yield to other
/// work on this processor; if there is much of it, sleep instead, because sleepers are scheduled
/// before threads that yield.
bool Relay::look(Duration most) {
  auto now = std::chrono::steady_clock::now();
  const auto end = now + std::chrono::nanoseconds(std::min(most.ns, kAwake.ns));
  for (;;) {
    note_answer();
    bool any = false;
    for (LocalReceiver* const receiver : receivers_) any = receiver->fetch() || any;
    if (any || !asked_ || now >= end || now < crowded_until_) return any;
    ::sched_yield();
    const auto before = std::exchange(now, std::chrono::steady_clock::now());
    if (now - before < kLongAway) continue;
    // A processor that stays busy is tried less and less often.
    const bool again = now - crowded_until_ < crowded_for_;
    crowded_for_ = again ? std::min(2 * crowded_for_, kMostCrowded) : kCrowded;
    crowded_until_ = now + crowded_for_;
  }
}

Relay::Came Relay::wait(Duration timeout) {
  Duration left{std::max<std::int64_t>(0, timeout.ns)};
  const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(left.ns);
  for (;; left = left_until(end)) {
    // Without an answer of the thread there was nothing.
    if (!asked_) {
      if (ready()) return Came::kSet;
      asked_ = true;
      ask_.release();
    }
    if (look(timeout.ns < 0 ? kAwake : left)) return Came::kSocket;
    if (!asked_) continue;
    if (timeout.ns > 0) left = left_until(end);
    const timespec most{left.ns / 1'000'000'000, left.ns % 1'000'000'000};
    const int count =
        ::ppoll(polled_.data(), polled_.size(), timeout.ns < 0 ? nullptr : &most, nullptr);
    if (count < 0 && errno == EINTR) continue;
    // The thread may be about to answer.
    if (count <= 0) return ready() ? Came::kSet : Came::kNothing;
    eventfd_t times = 0;
    if (polled_.front().revents != 0)
      static_cast<void>(::eventfd_read(event_.descriptor(), &times));
  }
}

}  // namespace rave::bus
