// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
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

/// Gives the answer to a request that takes time. Called once, from any thread; dropped before the
/// server is destroyed.
using Reply = std::function<void(Response)>;

/// What a server serves. All calls come from the thread of the server; none may block.
class Handler {
 public:
  virtual ~Handler() = default;
  /// Whether the answer is given later, by `reply`; otherwise serve() is asked.
  [[nodiscard]] virtual bool serve_later(const Request& /*request*/, const Reply& /*reply*/) {
    return false;
  }
  [[nodiscard]] virtual Response serve(const Request& request) = 0;
  /// What becomes of a request for a WebSocket at another path than `/ws`.
  struct Upgrade {
    std::optional<Response> refusal;  ///< The answer; nothing: it becomes a WebSocket.
    std::string subprotocol;          ///< One that the client named; empty: none.
  };
  /// Asked before anything is accepted. Such a path has rules of its own: the handler looks at
  /// `origin` itself.
  [[nodiscard]] virtual Upgrade upgrade(const Request& /*request*/) {
    return {text_response(404, "not found\n"), {}};
  }
  /// Whether a WebSocket is let in. Not: `reason` is told to the browser with a code from 4000 on.
  struct Admission {
    std::uint16_t refusal = 0;  ///< 0: welcome.
    std::string reason;
  };
  [[nodiscard]] virtual Admission admit(const Request& request) = 0;
  virtual void opened(std::uint64_t id, Socket& socket, const Request& request) = 0;
  virtual void received(std::uint64_t id, std::string_view text) = 0;
  /// A binary message. False: nobody takes those here, and the socket is closed with 1003.
  [[nodiscard]] virtual bool received_binary(std::uint64_t /*id*/, std::string_view /*bytes*/) {
    return false;
  }
  /// The socket is gone; it must not be used any more.
  virtual void closed(std::uint64_t id) = 0;
};

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: any.
  int ports_to_try = 1;    ///< A port in use means the next one, so many times.
  /// A chain of certificates and its private key, in PEM. Both empty: no TLS, which is for loopback
  /// alone.
  std::filesystem::path certificate;
  std::filesystem::path key;
  std::size_t connections = 512;
  std::size_t connections_per_network = 256;  ///< See network_of().
  double requests_per_s = 100;                ///< Of one network, and `request_burst` at once.
  double request_burst = 1000;
  double messages_per_s = 300;  ///< Of one WebSocket; who sends more is closed with 4429.
  double message_burst = 600;
  std::size_t request_bytes = std::size_t{1} << 16U;   ///< Header and body of a request.
  std::size_t message_bytes = std::size_t{1} << 16U;   ///< A message of a browser.
  std::size_t waiting_bytes = std::size_t{16} << 20U;  ///< More waiting: the socket is closed.
  int send_buffer_bytes = 64 << 10;  ///< Small, so that a slow line shows at once.
  std::chrono::seconds idle{15};     ///< Without an answer to a ping: gone. And for a request.
  std::string subprotocol;           ///< Of `/ws`, asked for by the page; empty: none.
  /// Pages of other origins may neither write nor open the WebSocket `/ws`. False: the handler
  /// looks at `origin` itself.
  bool own_origin_only = true;
};

/// What a server has done so far.
struct ServerCounts {
  std::uint64_t connections = 0;       ///< Accepted.
  std::uint64_t requests = 0;          ///< Of HTTP, those refused included.
  std::uint64_t refused_requests = 0;  ///< Malformed, foreign, too large or too many.
  std::uint64_t failed_handshakes = 0;
  std::uint64_t sockets_closed_for_rate = 0;
  std::uint64_t sent_bytes = 0;  ///< Of WebSockets.
  std::size_t open_connections = 0;
  std::size_t open_sockets = 0;
};

/// HTTP/1.1 and WebSockets on one thread of its own, with TLS if there is a certificate. Requests
/// with a foreign `Host` or `Origin` are refused (see ServerOptions::own_origin_only); every
/// response has a strict Content-Security-Policy.
class Server {
 public:
  /// Binds and starts. `handler` must outlive the server. Errors: kInvalidArgument (no address, or
  /// a certificate without a key), kIo (the port is in use, or the address is not of this machine),
  /// kNotFound, kParse and kState (the certificate or its key cannot be used).
  [[nodiscard]] static Result<std::unique_ptr<Server>> start(const ServerOptions& options,
                                                             Handler& handler);
  virtual ~Server() = default;

  [[nodiscard]] virtual std::uint16_t port() const noexcept = 0;
  /// `http://127.0.0.1:8080`; with TLS by the first name of the certificate. Any thread.
  [[nodiscard]] virtual std::string origin() const = 0;
  /// The thread of the server alone.
  [[nodiscard]] virtual ServerCounts counts() const = 0;
  /// Calls a function on the thread of the server, soon. Any thread.
  virtual void post(std::function<void()> call) = 0;
  /// Calls a function on the thread of the server again and again. Any thread.
  virtual void every(std::chrono::milliseconds period, std::function<void()> call) = 0;
  /// Closes all connections and ends the thread; bounded by two seconds. Idempotent; any thread but
  /// that of the server. The destructor does it.
  virtual void stop() = 0;
};

}  // namespace rave::web
