// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "rave/base/log.hpp"
#include "rave/bus/config.hpp"
#include "rave/control/run_control.hpp"
#include "rave/direct_line/lines.hpp"

namespace rave::launch {

/// Options of the direct line of a host.
struct LineArguments {
  /// `127.0.0.1:8090`, `:8090`, `8090`, `[::1]:8090` or an address alone; what is missing is
  /// loopback or any port. Unset: no line.
  std::optional<std::string> web;
  /// The file with the public key of the GUI Server; empty: `line.pub` beside the certificates.
  std::string web_key;
  std::string certificate;  ///< With `key`: TLS.
  std::string key;
};

/// A line and its announcement. Destroy it before the control that it was given.
struct HostLineEnds {
  std::unique_ptr<direct_line::LineServer> server;
  std::unique_ptr<direct_line::LineBeacon> beacon;  ///< Null: the GUI Server is here.
};

/// Opens the line of a host on a bus. Both members are null if no line is requested. Errors:
/// kInvalidArgument (an address, or no key), those of the key file, LineServer::start() and
/// LineBeacon::start().
[[nodiscard]] Result<HostLineEnds> open_host_line(const LineArguments& arguments,
                                                  const std::string& host,
                                                  const bus::BusConfig& bus,
                                                  runtime::RunControl& control, LogSink& log);

/// What the line of a run in this process is started with; `signer`, `run` and `host` are missing.
/// Errors: kInvalidArgument (an address).
[[nodiscard]] Result<direct_line::LineOptions> line_options(const LineArguments& arguments,
                                                            LogSink& log);

}  // namespace rave::launch
