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
  std::uint16_t port = 0;             ///< 0: any.
  std::filesystem::path certificate;  ///< With `key`: TLS. Needed on all addresses but loopback.
  std::filesystem::path key;
  std::string run;   ///< What tickets have to say.
  std::string host;  ///< The same.
  PublicKey signer{};
  LogSink* log = nullptr;  ///< Not owned; outlives the server. Null: nobody is told.
  /// Milliseconds since 1970, null: the clock of the day. For tests.
  std::function<std::int64_t()> clock_ms{};
};

/// What a line server has done so far.
struct LineCounts {
  std::uint64_t welcomed = 0;
  std::uint64_t refused_lines = 0;   ///< No ticket, or none that holds here.
  std::uint64_t refused_orders = 0;  ///< That the ticket does not cover, or no orders at all.
  std::uint64_t orders = 0;          ///< Given to the run.
  std::uint64_t withdrawn = 0;       ///< Lines that a withdrawal has ended.
  std::size_t open = 0;              ///< With a ticket.
};

/// The direct line of a host: pages with a ticket of the GUI Server give orders over a WebSocket
/// (`/ws`, subprotocol `rave.line.1`), straight to the run of this process. It neither knows nor
/// needs the GUI Server while it goes. A thread of its own.
class LineServer {
 public:
  /// `control`: of the run; outlives the server. Errors: kInvalidArgument (another address than
  /// loopback without TLS) and those of web::Server::start().
  [[nodiscard]] static Result<std::unique_ptr<LineServer>> start(const LineOptions& options,
                                                                 runtime::RunControl& control);
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;
  /// Robots that are driven stand first.
  ~LineServer();

  /// Where pages reach it: `ws://127.0.0.1:8090/ws`, with TLS `wss://` and the first name of the
  /// certificate. Any thread.
  [[nodiscard]] std::string url() const;
  [[nodiscard]] std::uint16_t port() const noexcept;
  /// A signed withdrawal (see ticket.hpp): tickets with a lower epoch end, and their lines. What
  /// the GUI Server has not signed is logged and forgotten. Any thread; soon.
  void withdraw(std::string signed_text);
  /// Waits for the thread of the server. Any other thread.
  [[nodiscard]] LineCounts counts() const;

 private:
  class Impl;
  explicit LineServer(std::unique_ptr<Impl> impl) noexcept;
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::direct_line
