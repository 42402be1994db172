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

/// What a host does on the bus for its line, in a thread of its own: tells where it is, and passes
/// on withdrawals.
class LineBeacon {
 public:
  /// `server` outlives it. Errors: those of bus::Bus::open().
  [[nodiscard]] static Result<std::unique_ptr<LineBeacon>> start(bus::BusConfig bus,
                                                                 const std::string& host,
                                                                 LineServer& server);
  LineBeacon(const LineBeacon&) = delete;
  LineBeacon& operator=(const LineBeacon&) = delete;
  ~LineBeacon();

 private:
  struct Impl;
  explicit LineBeacon(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::direct_line
