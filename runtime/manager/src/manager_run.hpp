// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drain.hpp"
#include "manager_endpoint.hpp"
#include "manager_habits.hpp"
#include "rave/manager/manager_run_options.hpp"
#include "served.hpp"

namespace rave::manager {

/// What the runs in lock-step and in real time have in common. `slots` of its functions are by
/// host. Belongs to one thread.
class ManagerRun {
 protected:
  /// Neither is owned.
  ManagerRun(const ManagerRunOptions& options, ManagerEndpoint& endpoint)
      : common_(options), endpoint_(endpoint) {}
  ~ManagerRun() = default;

  [[nodiscard]] bool stopping() const { return common_.stopping && common_.stopping(); }
  /// Whether a person or a signal asked for that, and not the loss of all processes.
  [[nodiscard]] bool by_hand() const {
    return common_.control != nullptr && common_.control->stopping();
  }
  [[nodiscard]] static std::string by_hand_text(double at_s) {
    return fmt::format("ended by hand at {:.2f} s", at_s);
  }
  /// Wakes from a wait when a request arrives.
  [[nodiscard]] std::stop_token asked() const {
    return common_.control != nullptr ? common_.control->asked() : std::stop_token();
  }
  template <class... Args>
  void log(LogLevel level, fmt::format_string<Args...> format, Args&&... args) {
    common_.log->write(level, kSource, fmt::format(format, std::forward<Args>(args)...));
  }

  /// The error about hosts that have lost their manager during a run and do not belong to this one.
  /// `where`: which hosts, and how far that run is.
  [[nodiscard]] Error of_another_run(std::string_view where) const {
    return {ErrorCode::kState,
            fmt::format("{} of a run that lost its environment manager: --resume continues that "
                        "run, `rave end {}` ends it, and --run with another name starts a new run",
                        where, common_.scenario),
            {}};
  }

  template <class Slots>
  void take_host_results(const Slots& slots) {
    endpoint_.take_host_results([&slots](std::uint64_t writer, std::uint32_t host) {
      return has_served(slots, writer, host);
    });
  }
  /// Waits until the hosts are gone, which know of the end; see drain().
  template <class Slots, class Turn>
  void drain_hosts(const Slots& slots, bool awaits_host_results, Turn&& turn) {
    const auto owes = [&](std::uint64_t writer) {
      return awaits_host_results && endpoint_.owes_host_results(writer);
    };
    drain(slots, common_.log, owes, turn);
    // Messages that a process sent before it left have arrived by now.
    take_host_results(slots);
  }
  template <class Slots>
  [[nodiscard]] std::vector<lock_step::HostResults> hand_out_host_results(const Slots& slots) {
    std::vector<lock_step::HostResults> results = endpoint_.hand_out_host_results();
    order_by_service(slots, results);
    return results;
  }

  const ManagerRunOptions& common_;
  ManagerEndpoint& endpoint_;
  bool begun_ = false;  ///< All hosts have been present, or it continues without some.
  std::vector<std::string> problems_;
  std::chrono::steady_clock::time_point next_tell_{};  ///< When its state is published again.
};

}  // namespace rave::manager
