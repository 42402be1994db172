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
  std::string name;      ///< That of its host in the scenario, or of the manager.
  std::string machine;   ///< Where it runs, as that calls itself; may be empty.
  bool manager = false;  ///< It is the environment manager of the run.
  bool live = false;     ///< The run is in real time: hosts alone control their robots.
};

/// What came of a request to one of several processes.
struct BusReply {
  BusPeer peer;
  Result<Answer> answer;
};

/// Asks the processes of a run on the bus, wherever they are. It takes no part in the run. One
/// owner thread.
class BusRun {
 public:
  /// So long an answer is waited for.
  static constexpr Duration kPatience{5'000'000'000};

  /// `config.run` is that of the run. `from`: who asks, for the logs of others; not empty. Errors:
  /// those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<BusRun>> open(bus::BusConfig config,
                                                            std::string_view from);
  BusRun(const BusRun&) = delete;
  BusRun& operator=(const BusRun&) = delete;
  ~BusRun();

  /// The process of this host; of the environment manager if `host` is empty. Waits for it up to
  /// `patience`. Error kNotFound with those that are there, or with what keeps all from being
  /// heard.
  [[nodiscard]] Result<BusPeer> find(std::string_view host, Duration patience = kPatience);
  /// All that are there: waits until for a moment nobody new has come, `patience` at most.
  [[nodiscard]] std::vector<BusPeer> all(Duration patience = kPatience);

  /// Asks and waits for the answer. Errors: kTimeout (there was none), kState (the process is
  /// gone), kInvalidArgument (what the bus does not carry), kParse.
  [[nodiscard]] Result<Answer> ask(const BusPeer& peer, const Request& request,
                                   Duration patience = kPatience);

  /// Whether a process of a run of this scenario, which is empty as long as its manager has not
  /// said it, is to be asked.
  using Meant = std::function<bool(const BusPeer&, const std::string& scenario)>;
  /// Asks all that are meant, each as soon as it is found, and waits for none of them before it
  /// asks another: until for a moment nobody new has come and all have answered, `patience` at
  /// most. For requests with short answers. The errors of replies are those of ask().
  [[nodiscard]] std::vector<BusReply> ask_each(const Request& request, const Meant& meant,
                                               Duration patience = kPatience);

 private:
  struct Impl;
  explicit BusRun(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::control
