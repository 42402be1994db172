// SPDX-License-Identifier: Apache-2.0
// The thread of a guard. It shares orders and news with the engine under a mutex that is held for a
// swap only, and calls drivers without it.
#include "guard_thread.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <utility>

#include "rave/base/crash_note.hpp"
#include "rave/base/thread.hpp"

namespace rave::sim {
namespace {

using Clock = std::chrono::steady_clock;

/// Above all that has no priority in real time, below the kernel's own threads.
constexpr int kPriority = 10;

bool raise_priority(std::thread& thread) {
  sched_param param{};
  param.sched_priority = kPriority;
  return pthread_setschedparam(thread.native_handle(), SCHED_FIFO, &param) == 0;
}

}  // namespace

GuardThread::GuardThread(Setup setup, std::string_view robot)
    : setup_(std::move(setup)),
      robot_(robot),
      guard_(setup_.limits, setup_.pose, setup_.sensors, setup_.period, setup_.ranges) {
  const std::size_t count = setup_.actuators.size();
  allowed_.resize(count);
  written_.resize(count);
  news_.written.resize(count);
}

Result<std::unique_ptr<GuardThread>> GuardThread::start(Setup setup, std::string_view robot) {
  std::unique_ptr<GuardThread> guard(new GuardThread(std::move(setup), robot));
  RAVE_TRY(start_thread(guard->thread_, fmt::format("the guard of robot `{}`", robot),
                        [&self = *guard] { self.run(); }));
  // A refusal is no error: most systems grant no real-time priority. The engine tells the user.
  guard->has_priority_ = raise_priority(guard->thread_);
  return guard;
}

GuardThread::~GuardThread() {
  retire();
  join();
}

void GuardThread::give_order() {
  {
    const std::lock_guard lock(mutex_);
    // Three orders go round: the one that the engine fills, the latest, and the one in use. So
    // neither side waits while the other works on its own.
    std::swap(next_, latest_);
    fresh_ = true;
    woken_ = true;
    stands_ = false;
  }
  wake_.notify_one();
}

void GuardThread::stand() {
  {
    const std::lock_guard lock(mutex_);
    stands_ = true;
    woken_ = true;
  }
  wake_.notify_one();
}

bool GuardThread::retire() {
  bool first = false;
  {
    const std::lock_guard lock(mutex_);
    first = !std::exchange(retired_, true);
    woken_ = true;
  }
  wake_.notify_one();
  return first;
}

void GuardThread::join() {
  if (thread_.joinable()) thread_.join();
}

void GuardThread::look(GuardNews& news) {
  {
    const std::lock_guard lock(mutex_);
    news.begun = std::exchange(news_.begun, 0);
    news.lost_sensor = news_.lost_sensor;
    news.frozen_sensor = news_.frozen_sensor;
    news.written = news_.written;
  }
  // An atomic and not under the mutex: a driver that hangs must be noticed while it hangs.
  const std::int64_t since_ns = writing_since_ns_;
  news.stuck = {};
  if (since_ns != kNotWriting) news.stuck = {setup_.clock->now().ns - since_ns};
}

void GuardThread::run() {
  auto due = Clock::now();
  // A new order is served at once and does not shift the periodic checks.
  for (;;) {
    bool stands = false;
    bool ends = false;
    {
      std::unique_lock lock(mutex_);
      wake_.wait_until(lock, due, [this] { return woken_; });
      woken_ = false;
      // The order that is replaced goes back to be filled anew: nothing is allocated.
      if (std::exchange(fresh_, false)) {
        std::swap(order_, latest_);
        ordered_ = true;
      }
      ends = retired_;
      stands = stands_ || retired_;
    }
    // Before the first order there is no command, and a driver may not expect one.
    if (ordered_) write_all(stands);
    if (ends) return;
    const auto now = Clock::now();
    // After a pause of the process there is one check, not one for each period missed.
    if (now >= due) due = std::max(due + std::chrono::nanoseconds(setup_.period.ns), now);
  }
}

void GuardThread::write_all(bool stands) {
  const SimTime now = setup_.clock->now();
  const std::size_t count = std::min(order_.demands.size(), allowed_.size());
  if (stands) {
    for (std::size_t a = 0; a < count; ++a) {
      allowed_[a] = order_.demands[a].drive.standing(order_.demands[a].expected);
    }
    guard_.stand();
  } else {
    guard_.limit(order_, now, allowed_);
  }
  for (std::size_t a = 0; a < count; ++a) write(a, allowed_[a], now);
  // Only now: while drivers write, the engine may give orders.
  const std::lock_guard lock(mutex_);
  news_.begun |= guard_.take_begun();
  news_.lost_sensor = guard_.lost_sensor();
  news_.frozen_sensor = guard_.frozen_sensor();
  for (std::size_t a = 0; a < count; ++a) news_.written[a] = written_[a];
}

void GuardThread::write(std::size_t actuator, const Command& command, SimTime now) {
  const GuardedActuator& to = setup_.actuators[actuator];
  if (to.ops == nullptr || command.kind == CommandKind::kNone) return;
  ErrorText error;
  const CrashNote whose{"actuator", to.driver.c_str(), robot_.c_str(), robot_.c_str()};
  const CrashScope scope(whose);
  writing_since_ns_ = now.ns;
  const bool failed = to.ops->write(to.instance, &command, now.ns, &error) != 0;
  writing_since_ns_ = kNotWriting;
  WrittenCommand& written = written_[actuator];
  written.command = command;
  // The text of the first failure stays, until a write succeeds.
  if (failed && !written.failed) written.text = error.text;
  written.failed = failed;
}

}  // namespace rave::sim
