// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"
#include "rave/direct_line/ticket.hpp"

namespace rave::direct_line {

struct LineOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: a free port.
  /// If set with `key`: TLS. Required on all addresses but loopback.
  std::filesystem::path certificate;
  std::filesystem::path key;
  std::string run;   ///< The run that tickets must name.
  std::string host;  ///< The host that tickets must name.
  PublicKey signer{};
  LogSink* log = nullptr;  ///< Not owned; must outlive the server. May be null.
  /// Returns milliseconds since 1970; empty: the system clock. For tests.
  std::function<std::int64_t()> clock_ms{};
};

/// The direct line of a host: pages with a ticket of the GUI Server send orders over a WebSocket
/// (`/ws`, subprotocol `rave.line.1`) directly to the run of this process. It does not need the GUI
/// Server to be reachable. Runs in a thread of its own.
class LineServer {
 public:
  /// `control`: of the run; must outlive the server. Errors: kInvalidArgument (another address than
  /// loopback without TLS) and those of web::Server::start().
  [[nodiscard]] static Result<std::unique_ptr<LineServer>> start(const LineOptions& options,
                                                                 runtime::RunControl& control);
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;
  /// Stops robots that are driven, then closes.
  ~LineServer();

  /// The address for pages: `ws://127.0.0.1:8090/ws`, with TLS `wss://` and the first name in the
  /// certificate. Any thread.
  [[nodiscard]] std::string url() const;
  [[nodiscard]] std::uint16_t port() const noexcept;
  /// Processes a signed withdrawal (see ticket.hpp): tickets with a lower epoch and their lines
  /// end. A text with an invalid signature is logged and ignored. Asynchronous. Any thread.
  void withdraw(std::string signed_text);

 private:
  class Impl;
  explicit LineServer(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::direct_line
