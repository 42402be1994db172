// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/web/message.hpp"

namespace rave::web {

/// What is sent over a WebSocket; shared, so that one encoding serves many.
using Payload = std::shared_ptr<const std::string>;

/// One open WebSocket. Only the thread of the server may use it.
class Socket {
 public:
  virtual ~Socket() = default;
  virtual void send_text(Payload text) = 0;
  virtual void send_binary(Payload bytes) = 0;
  /// Closes it once what was sent before has gone out. `code`: RFC 6455, 4000 to 4999 are ours.
  virtual void close(std::uint16_t code, std::string_view reason) = 0;
  /// Bytes that were given to send and have not gone to the kernel yet.
  [[nodiscard]] virtual std::size_t waiting_bytes() const noexcept = 0;
};

/// What a server serves. All calls come from the thread of the server; none may block.
class Handler {
 public:
  virtual ~Handler() = default;
  [[nodiscard]] virtual Response serve(const Request& request) = 0;
  /// Whether a WebSocket is let in. Not: `reason` is told to the browser with a code from 4000 on.
  struct Admission {
    std::uint16_t refusal = 0;  ///< 0: welcome.
    std::string reason;
  };
  [[nodiscard]] virtual Admission admit(const Request& request) = 0;
  virtual void opened(std::uint64_t id, Socket& socket, const Request& request) = 0;
  virtual void received(std::uint64_t id, std::string_view text) = 0;
  /// The socket is gone; it must not be used any more.
  virtual void closed(std::uint64_t id) = 0;
};

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: any.
  int ports_to_try = 1;    ///< A port in use means the next one, so many times.
  std::size_t connections = 512;
  std::size_t request_bytes = std::size_t{1} << 16U;   ///< Header and body of a request.
  std::size_t message_bytes = std::size_t{1} << 16U;   ///< A message of a browser.
  std::size_t waiting_bytes = std::size_t{16} << 20U;  ///< More waiting: the socket is closed.
  int send_buffer_bytes = 64 << 10;  ///< Small, so that a slow line shows at once.
  std::chrono::seconds idle{15};     ///< Without an answer to a ping: gone. And for a request.
  std::string subprotocol;           ///< Asked for by the page; empty: none.
};

/// HTTP/1.1 and WebSockets on one thread of its own. Requests with a foreign `Host` or `Origin` are
/// refused; every response has a strict Content-Security-Policy.
class Server {
 public:
  /// Binds and starts. `handler` must outlive the server. Errors: kIo (the port is in use, or the
  /// address is not of this machine).
  [[nodiscard]] static Result<std::unique_ptr<Server>> start(const ServerOptions& options,
                                                             Handler& handler);
  virtual ~Server() = default;

  [[nodiscard]] virtual std::uint16_t port() const noexcept = 0;
  /// Calls a function on the thread of the server, soon. Any thread.
  virtual void post(std::function<void()> call) = 0;
  /// Calls a function on the thread of the server again and again. Any thread.
  virtual void every(std::chrono::milliseconds period, std::function<void()> call) = 0;
  /// Closes all connections and ends the thread; bounded by two seconds. Idempotent; any thread but
  /// that of the server. The destructor does it.
  virtual void stop() = 0;
};

}  // namespace rave::web
