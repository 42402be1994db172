// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/bus.hpp"
#include "rave/bus/config.hpp"
#include "rave/watch/run_view.hpp"

namespace rave::watch {

/// A run found in a domain.
struct FoundRun {
  bus::RunId run;
  std::vector<std::string> processes;  ///< Their participant names, sorted.
};

/// A list of runs for people, each with its first eight digits and its processes.
[[nodiscard]] std::string list_of(const std::vector<FoundRun>& runs);

/// Returns true to stop the search; argument: the runs found so far.
using Enough = std::function<bool(const std::vector<FoundRun>&)>;

/// Finds the runs in the domain of `config`, whose run is ignored. The search ends after
/// `patience`, or earlier when `enough` returns true; it is called in the caller's thread for each
/// new process. Without `enough` the search ends when no new process has appeared for a moment,
/// which is fast but may miss slow ones. Runs with more processes come first. Errors: those of
/// bus::Bus::open().
[[nodiscard]] Result<std::vector<FoundRun>> find_runs(bus::BusConfig config, Duration patience,
                                                      const Enough& enough = {},
                                                      const std::stop_token& stop = {});

/// Whether a word is the full name of a run, as in --run, or its full number.
[[nodiscard]] bool is_named(const bus::RunId& run, std::string_view word);

/// Like is_named(), or the first digits of its number, at least four.
[[nodiscard]] bool is_called(const bus::RunId& run, std::string_view word);

/// The run of `found` that a word refers to: the first digits of its number (at least four), or a
/// name as in --run; empty: the only one. Error kNotFound if none or several match.
[[nodiscard]] Result<bus::RunId> choose_run(const std::vector<FoundRun>& found,
                                            std::string_view word);

/// Monitors one run on the bus. It only reads, never requests retransmissions, and no process of
/// the run waits for it. It may join and leave at any time. One owner thread.
class Observer {
 public:
  /// Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<Observer>> open(bus::BusConfig config);
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  ~Observer();

  /// Receives data for `span`, or until a stop is requested, which any thread may do.
  void watch(Duration span, const std::stop_token& stop = {});
  /// The present view of the run. `with_robots`: include robots.
  [[nodiscard]] RunView view(bool with_robots) const;
  /// See RunModel::kept().
  [[nodiscard]] std::vector<KeptAt> kept() const;
  /// Whether any process of the run has been found.
  [[nodiscard]] bool knows_any() const;
  /// The bus, for objects of this thread that end before it.
  [[nodiscard]] bus::Bus& bus() noexcept;

 private:
  struct Impl;
  explicit Observer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::watch
