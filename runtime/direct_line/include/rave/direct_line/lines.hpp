// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/direct_line/line_server.hpp"

namespace rave::direct_line {

/// The direct line of one host, for pages.
struct HostLine {
  std::string host;
  std::string url;
  std::vector<std::string> robots;  ///< All robots of the host.
  friend bool operator==(const HostLine&, const HostLine&) = default;
};

/// The direct lines of a run. Any thread.
class Lines {
 public:
  virtual ~Lines() = default;
  /// The name of the run in tickets.
  [[nodiscard]] virtual std::string run() const = 0;
  [[nodiscard]] virtual std::vector<HostLine> hosts() const = 0;
  /// Sends a withdrawal to all hosts, including those that start later. `signed_text`: see
  /// sign_withdrawal().
  virtual void withdraw(const std::string& user, const std::string& signed_text) = 0;
};

/// The line of a run in this process. `server` must outlive it.
[[nodiscard]] std::unique_ptr<Lines> lines_here(LineServer& server, std::string run, HostLine line);

/// The lines of a run on a bus, in a thread of its own: hosts announce them on `rave/line` and
/// receive withdrawals on `rave/withdrawal`. `robots_of` returns the robots of a host by its name,
/// empty for an unknown host; it is called in that thread. Errors: those of bus::Bus::open();
/// kIo if the system grants no thread.
[[nodiscard]] Result<std::unique_ptr<Lines>> lines_on_bus(
    bus::BusConfig bus, std::function<std::vector<std::string>(const std::string&)> robots_of);

/// Announces the line of a host on the bus and receives withdrawals, in a thread of its own. The
/// announcement begins with the run.
class LineBeacon {
 public:
  /// `host`: its name in the scenario. `control`: of the run of this process. The
  /// last three arguments must outlive the beacon. If the bus cannot be opened, it logs a warning
  /// and the run continues. Error kIo: the system creates no thread.
  [[nodiscard]] static Result<std::unique_ptr<LineBeacon>> start(bus::BusConfig bus,
                                                                 const std::string& host,
                                                                 LineServer& server,
                                                                 const runtime::RunControl& control,
                                                                 LogSink& log);
  LineBeacon(const LineBeacon&) = delete;
  LineBeacon& operator=(const LineBeacon&) = delete;
  ~LineBeacon();

 private:
  struct Impl;
  explicit LineBeacon(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::direct_line
