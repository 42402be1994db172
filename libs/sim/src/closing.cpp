// SPDX-License-Identifier: Apache-2.0
// Drivers are closed one after the other in a thread, within a limit each. One that hangs is left
// behind with its thread, and the run ends without it.
#include "closing.hpp"

#include <algorithm>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "rave/base/crash_note.hpp"

namespace rave::sim {
namespace {

using Clock = std::chrono::steady_clock;

/// How long the others have once one has not returned: many may be of the same kind.
constexpr std::chrono::milliseconds kLater{1000};

/// What the caller and its threads share. A thread that was left behind has nothing else.
struct Closing {
  std::vector<ToClose> drivers;
  /// Nothing is done with it; who looks for lost memory finds that a thread holds it.
  const void* owner = nullptr;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::size_t> stuck;
  std::size_t next = 0;                    ///< The first that no thread has begun to close.
  std::size_t turn = 0;                    ///< Of which thread it is; others have been left behind.
  std::optional<Clock::time_point> since;  ///< When the thread has begun with its last.
  bool is_done = false;

  /// Whether something of the robot may still use the device.
  [[nodiscard]] bool is_in_use(const ToClose& device) const {
    return std::any_of(stuck.begin(), stuck.end(),
                       [&](std::size_t s) { return drivers[s].robot == device.robot; });
  }
};

void close_in_order(Closing& closing, std::size_t turn) {
  std::unique_lock lock(closing.mutex);
  while (closing.turn == turn && closing.next < closing.drivers.size()) {
    const ToClose& driver = closing.drivers[closing.next];
    ++closing.next;
    // Closing a device under a driver that still uses it could crash the process; left open, it
    // ends with the process.
    if (driver.is_shared && closing.is_in_use(driver)) continue;
    closing.since = Clock::now();
    closing.changed.notify_all();
    // close() may take any time; the caller has to see `since` meanwhile.
    lock.unlock();
    {
      const CrashNote whose{driver.kind, driver.driver, driver.robot_name, driver.robot_name};
      const CrashScope scope(whose);
      driver.close(driver.instance);
    }
    lock.lock();
  }
  // It was given up while it closed the last one; another thread continues with the others.
  if (closing.turn != turn) return;
  closing.is_done = true;
  closing.changed.notify_all();
}

/// None if the system has none left: then they are closed without a limit, not left open.
std::thread in_thread(const std::shared_ptr<Closing>& closing) {
  try {
    return std::thread([closing, turn = closing->turn] { close_in_order(*closing, turn); });
  } catch (const std::system_error&) {
    return {};
  }
}

}  // namespace

// A thread closes one driver after the other while this one watches. If one does not return in
// time, its thread is left behind and another continues with the next driver.
std::vector<ToClose> close_within(std::vector<ToClose> drivers, std::chrono::milliseconds limit,
                                  const void* owner) {
  if (drivers.empty()) return {};
  const auto closing = std::make_shared<Closing>();
  closing->drivers = std::move(drivers);
  closing->owner = owner;
  std::unique_lock lock(closing->mutex);
  const auto is_late = [&] { return closing->since && Clock::now() >= *closing->since + limit; };
  for (;;) {
    closing->since.reset();
    std::thread thread = in_thread(closing);
    if (!thread.joinable()) {
      lock.unlock();
      close_in_order(*closing, closing->turn);
      lock.lock();
    }
    while (!closing->is_done && !is_late()) {
      if (closing->since) {
        closing->changed.wait_until(lock, *closing->since + limit);
      } else {
        closing->changed.wait(lock);
      }
    }
    if (closing->is_done) {
      lock.unlock();
      if (thread.joinable()) thread.join();
      std::vector<ToClose> stuck;
      for (const std::size_t s : closing->stuck) stuck.push_back(closing->drivers[s]);
      return stuck;
    }
    // The one that the thread had begun with last; its number is behind `next`.
    closing->stuck.push_back(closing->next - 1);
    ++closing->turn;
    limit = std::min(limit, kLater);
    thread.detach();
  }
}

}  // namespace rave::sim
