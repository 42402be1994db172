// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/direct_line/line_server.hpp"

namespace rave::direct_line {

/// The direct line of one host, as the GUI Server tells pages.
struct HostLine {
  std::string host;
  std::string url;
  std::vector<std::string> robots;  ///< All of the host.
  friend bool operator==(const HostLine&, const HostLine&) = default;
};

/// The hosts of a run that have a direct line. Any thread.
class Lines {
 public:
  virtual ~Lines() = default;
  /// As tickets call the run.
  [[nodiscard]] virtual std::string run() const = 0;
  [[nodiscard]] virtual std::vector<HostLine> hosts() const = 0;
  /// Tells all hosts, those that come later included. `signed_text`: see sign_withdrawal().
  virtual void withdraw(const std::string& user, const std::string& signed_text) = 0;
};

/// The line of a run of this process. `server` outlives it.
[[nodiscard]] std::unique_ptr<Lines> lines_here(LineServer& server, std::string run, HostLine line);

/// Those of a run on a bus, in a thread of its own: hosts tell where they are on `rave/line`, and
/// are told on `rave/withdrawal`. `robots_of`: the robots of a host by its name, empty if the run
/// has no such host; called in that thread. Errors: those of bus::Bus::open().
[[nodiscard]] Result<std::unique_ptr<Lines>> lines_on_bus(
    bus::BusConfig bus, std::function<std::vector<std::string>(const std::string&)> robots_of);

/// As the line of the environment manager is called. In lock-step orders go there, and in real time
/// to each host.
inline constexpr const char* kManagerHost = "environment manager";

/// What a process does on the bus for its line, in a thread of its own: once the run is there, it
/// tells where the line is, if this process takes the orders, and passes on withdrawals.
class LineBeacon {
 public:
  /// `host`: its name in the scenario, or kManagerHost. `control`: of the run of this process. The
  /// last three outlive it. A bus that cannot be opened is a warning in the log: the run goes on.
  [[nodiscard]] static std::unique_ptr<LineBeacon> start(bus::BusConfig bus,
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
