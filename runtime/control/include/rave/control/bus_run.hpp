// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"
#include "rave/control/protocol.hpp"

namespace rave::control {

/// A process of a run on the bus.
struct BusPeer {
  std::uint64_t writer = 0;
  std::string name;      ///< Name of its host in the scenario, or of the manager.
  std::string machine;   ///< Host name of its machine; may be empty.
  bool manager = false;  ///< Whether it is the Environment Manager of the run.
  bool live = false;     ///< Whether the run is in real time; then only hosts accept requests for
                         ///< their robots.
  bus::RunId run{};
};

/// The reply of one of several processes to a request.
struct BusReply {
  BusPeer peer;
  Result<Answer> answer;
};

/// Sends requests to the processes of a run, or of all runs, over the bus. It is not part of a run.
/// One owner thread.
class BusRun {
 public:
  /// The default timeout for an answer.
  static constexpr Duration kPatience{5'000'000'000};

  /// `config.run` must be the id of the run, or `config.all_runs` set; then only ask_each() may be
  /// called. `from`: name of the sender for the logs of others; not empty. Errors: those of
  /// bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<BusRun>> open(bus::BusConfig config,
                                                            std::string_view from);
  BusRun(const BusRun&) = delete;
  BusRun& operator=(const BusRun&) = delete;
  ~BusRun();

  /// The process of this host; with an empty `host` that of the Environment Manager. Waits for up
  /// to `patience`. Error kNotFound lists the processes found, or says what prevents communication.
  [[nodiscard]] Result<BusPeer> find(std::string_view host, Duration patience = kPatience);
  /// All processes of the run. Waits until no new one has appeared for a moment, at most
  /// `patience`.
  [[nodiscard]] std::vector<BusPeer> all(Duration patience = kPatience);

  /// Sends a request and waits for the answer. Errors: kTimeout (no answer), kState (the process is
  /// gone), kInvalidArgument (a request that the bus does not carry), kParse.
  [[nodiscard]] Result<Answer> ask(const BusPeer& peer, const Request& request,
                                   Duration patience = kPatience);

  /// Selects the processes to ask. `scenario` is that of their run; empty until its manager has
  /// announced it.
  using Meant = std::function<bool(const BusPeer&, const std::string& scenario)>;
  /// How long processes are searched for while others may still be meant.
  struct Search {
    Duration duration;
    /// Whether the run of a process is the only one that can be meant; then the search ends when no
    /// new process has appeared for a moment.
    std::function<bool(const BusPeer&)> only;
  };
  /// Sends a request to all selected processes in parallel, each as soon as it is found. Returns
  /// when no new process has appeared for a moment and all have answered, at most after `patience`.
  /// For requests with short answers. The errors of replies are those of ask().
  [[nodiscard]] std::vector<BusReply> ask_each(const Request& request, const Meant& meant,
                                               Duration patience = kPatience,
                                               const Search* search = nullptr);

 private:
  struct Impl;
  explicit BusRun(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::control
