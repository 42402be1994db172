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
#include "rave/bus/config.hpp"
#include "rave/watch/run_view.hpp"

namespace rave::watch {

/// A run that processes in the domain belong to.
struct FoundRun {
  bus::RunId run;
  std::vector<std::string> processes;  ///< As they call themselves; in order.
};

/// Those for people, each with its first eight digits and its processes.
[[nodiscard]] std::string list_of(const std::vector<FoundRun>& runs);

/// Whether one has found what one looks for, of the runs so far.
using Enough = std::function<bool(const std::vector<FoundRun>&)>;

/// Looks who is in the domain of `config`, whose run does not count, for `patience` or until it is
/// `enough`, which is asked whenever somebody has come, in the caller's thread. Null: once somebody
/// is found, until nobody new has come for a moment, which is quick and may miss who is slow. Runs
/// with more processes come first. Errors: those of bus::Bus::open().
[[nodiscard]] Result<std::vector<FoundRun>> find_runs(bus::BusConfig config, Duration patience,
                                                      const Enough& enough = {},
                                                      const std::stop_token& stop = {});

/// Whether a word is the whole name of a run, as given with --run, or its whole number.
[[nodiscard]] bool is_named(const bus::RunId& run, std::string_view word);

/// The same, or the first digits of its number, at least four.
[[nodiscard]] bool is_called(const bus::RunId& run, std::string_view word);

/// The one of `found` that a word stands for: the first digits of its number (at least four), or a
/// name that was given with --run; empty: the only one. Error kNotFound if it is none of them or
/// there are several.
[[nodiscard]] Result<bus::RunId> choose_run(const std::vector<FoundRun>& found,
                                            std::string_view word);

/// Looks on at one run on the bus. It reads only, asks no writer to send anything again, and no
/// process of the run waits for it or takes notice of it. It may come and go at any time. One owner
/// thread.
class Observer {
 public:
  /// Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<Observer>> open(bus::BusConfig config);
  Observer(const Observer&) = delete;
  Observer& operator=(const Observer&) = delete;
  ~Observer();

  /// Takes in what comes for so long, or until a stop is requested, which any thread may do.
  void watch(Duration span, const std::stop_token& stop = {});
  /// The run as it is now. `with_robots`: each robot, too.
  [[nodiscard]] RunView view(bool with_robots) const;
  /// Whether any process of the run has been heard of.
  [[nodiscard]] bool knows_any() const;

 private:
  struct Impl;
  explicit Observer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::watch
