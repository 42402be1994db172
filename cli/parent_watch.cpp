// SPDX-License-Identifier: Apache-2.0
#include "parent_watch.hpp"

#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "rave/base/thread.hpp"
#include "rave/control/bus_run.hpp"

namespace rave::cli {
namespace {

constexpr std::chrono::milliseconds kLookAtParent{500};
/// For an Environment Manager to be found.
constexpr Duration kManagerSearch = from_seconds(3);

bool has_manager(bus::BusConfig bus) {
  bus.side = bus::Side::kManager;
  bus.beside = true;
  const auto run = control::BusRun::open(std::move(bus), "host");
  return run && (*run)->find("", kManagerSearch).has_value();
}

}  // namespace

Status ParentWatch::start(const bus::BusConfig& bus, Duration patience,
                          runtime::RunControl& control, LogSink& log) {
  const pid_t parent = ::getppid();
  return start_thread(
      thread_, "the watch over the starter",
      [bus, patience, parent, &control, &log](const std::stop_token& stop) {
        std::mutex mutex;
        std::condition_variable_any stopped;
        std::unique_lock lock(mutex);
        const std::chrono::nanoseconds longest(patience.ns);
        std::optional<std::chrono::steady_clock::time_point> until;
        while (!stop.stop_requested()) {
          stopped.wait_for(lock, stop, kLookAtParent, [] { return false; });
          const auto now = std::chrono::steady_clock::now();
          // The kernel gives the children of a process that died to another one.
          if (!until && ::getppid() != parent) {
            until = now + longest;
            log.warn("host", "the process that started this host has ended");
          }
          if (!until || now < *until || stop.stop_requested()) continue;
          if (has_manager(bus)) {
            until = now + longest;
            continue;
          }
          log.error("host", "no environment manager has taken its place for {:g} s; the host ends",
                    static_cast<double>(patience.ns) * 1e-9);
          return control.stop();
        }
      });
}

}  // namespace rave::cli
