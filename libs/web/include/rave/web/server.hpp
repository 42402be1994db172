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

/// The content of a WebSocket message; shared, so that it is encoded once for many sockets.
using Payload = std::shared_ptr<const std::string>;

/// One open WebSocket. Only the thread of the server may use it.
class Socket {
 public:
  virtual ~Socket() = default;
  virtual void send_text(Payload text) = 0;
  virtual void send_binary(Payload bytes) = 0;
  /// Closes the socket after all earlier messages were sent. `code`: RFC 6455; RAVE uses 4000 to
  /// 4999.
  virtual void close(std::uint16_t code, std::string_view reason) = 0;
  /// Bytes passed to send but not yet to the kernel.
  [[nodiscard]] virtual std::size_t waiting_bytes() const noexcept = 0;
};

/// Completes a request that takes time. Call it once, from any thread; it must not outlive the
/// server.
using Reply = std::function<void(Response)>;

/// Whose request it is, for limits: those of one visitor come before those of an address.
struct Caller {
  /// Who gets a place when others do not any more.
  enum class Rank : std::uint8_t {
    kAnyone,
    kMayStop,  ///< May stop robots: has half of the reserve.
    kAlways,   ///< A super-user: has all of it, and no limits of their own.
  };
  std::string session{};  ///< Of whom its handler knows; empty: a stranger.
  std::string user{};     ///< The sessions of one user are counted together, too.
  Rank rank = Rank::kAnyone;
  /// The request is as cheap as its refusal, such as that of the page for signing in, which
  /// strangers must be able to reach whatever others at their address do.
  bool cheap = false;
};

/// The application of a server. All calls come from the thread of the server; none may block.
class Handler {
 public:
  virtual ~Handler() = default;
  /// Asked before everything else about a request; fast.
  [[nodiscard]] virtual Caller caller(const Request& /*request*/) { return {}; }
  /// Returns true if the response follows through `reply`; if false, serve() is called.
  [[nodiscard]] virtual bool serve_later(const Request& /*request*/, const Reply& /*reply*/) {
    return false;
  }
  [[nodiscard]] virtual Response serve(const Request& request) = 0;
  /// The decision on a WebSocket request for a path other than `/ws`.
  struct Upgrade {
    std::optional<Response> refusal;  ///< Response that refuses it; empty: it becomes a WebSocket.
    std::string subprotocol;          ///< One of the client's subprotocols; empty: none.
  };
  /// Called before the connection is accepted. `own_origin_only` does not apply to such paths; the
  /// handler must check `origin` itself.
  [[nodiscard]] virtual Upgrade upgrade(const Request& /*request*/) {
    return {text_response(404, "not found\n"), {}};
  }
  /// The decision on a WebSocket at `/ws`. If refused, the browser receives the code (4000 or
  /// above) and `reason`.
  struct Admission {
    std::uint16_t refusal = 0;  ///< 0: admitted.
    std::string reason;
  };
  [[nodiscard]] virtual Admission admit(const Request& request) = 0;
  virtual void opened(std::uint64_t id, Socket& socket, const Request& request) = 0;
  virtual void received(std::uint64_t id, std::string_view text) = 0;
  /// A binary message. False: not supported; the socket is closed with 1003.
  [[nodiscard]] virtual bool received_binary(std::uint64_t /*id*/, std::string_view /*bytes*/) {
    return false;
  }
  /// A WebSocket is refused with 4430 because there is no room for it.
  virtual void crowded(const Request& /*request*/, std::string_view /*why*/) {}
  /// The socket exceeds `messages_per_s` and is closed with 4429 after this call.
  virtual void flooded(std::uint64_t /*id*/) {}
  /// The socket is closed and must not be used any more.
  virtual void closed(std::uint64_t id) = 0;
};

struct ServerOptions {
  std::string address = "127.0.0.1";
  std::uint16_t port = 0;  ///< 0: a free port.
  int ports_to_try = 1;    ///< How many ports to try, counting up, while they are in use.
  /// Certificate chain and private key, in PEM. Both empty: no TLS, which is for loopback only.
  std::filesystem::path certificate;
  std::filesystem::path key;
  /// HTTP connections. If there are more, the oldest of who has the most is cut.
  std::size_t connections = 256;
  std::size_t connections_per_session = 16;
  /// New connections of an address, of which each may cost a TLS handshake, and three times as many
  /// of a network (network_of()); `accept_burst` at once. No limit for this machine.
  double accepts_per_s = 400;
  double accept_burst = 2000;
  /// WebSockets; see Caller. One that exceeds a limit is closed with 4430.
  std::size_t sockets = 448;
  std::size_t sockets_per_session = 32;
  std::size_t sockets_per_user = 64;
  std::size_t sockets_per_address = 224;
  std::size_t sockets_per_network = 256;
  std::size_t reserve =
      64;  ///< More than these, for users who may stop robots, and for super-users.
  /// Per session, or for strangers per address; `request_burst` at once.
  double requests_per_s = 100;
  double request_burst = 1000;
  /// Per WebSocket, and four times as many per session; a socket that exceeds it is closed with
  /// 4429.
  double messages_per_s = 300;
  double message_burst = 600;
  std::size_t request_bytes = std::size_t{1} << 16U;  ///< Limit of header and body of a request.
  std::size_t message_bytes = std::size_t{1} << 16U;  ///< Limit of a message from a browser.
  /// A socket with more unsent bytes is closed.
  std::size_t waiting_bytes = std::size_t{16} << 20U;
  int send_buffer_bytes = 64 << 10;  ///< Small, so that a slow connection is detected at once.
  /// A WebSocket from which nothing came for this long, not even the answer to a ping, is closed;
  /// so is an incomplete request.
  std::chrono::seconds idle{15};
  std::string subprotocol;  ///< Subprotocol of `/ws`, requested by the page; empty: none.
  /// Whether pages of other origins are denied POST requests and the WebSocket `/ws`. False: the
  /// handler checks `origin` itself.
  bool own_origin_only = true;
};

/// Counters of a server.
struct ServerCounts {
  std::uint64_t connections = 0;       ///< Accepted.
  std::uint64_t requests = 0;          ///< HTTP requests, refused ones included.
  std::uint64_t refused_requests = 0;  ///< Malformed, of a foreign origin, too large or too many.
  std::uint64_t failed_handshakes = 0;
  std::uint64_t sockets_closed_for_rate = 0;
  std::uint64_t sockets_without_room = 0;
  std::uint64_t sent_bytes = 0;  ///< Over WebSockets.
  std::size_t open_connections = 0;
  std::size_t open_sockets = 0;
};

/// An HTTP/1.1 and WebSocket server on one thread of its own, with TLS if there is a certificate.
/// Requests with a foreign `Host` or `Origin` are refused (see ServerOptions::own_origin_only).
/// Every response has a strict Content-Security-Policy.
class Server {
 public:
  /// Binds and starts. `handler` must outlive the server. Errors: kInvalidArgument (no address, or
  /// a certificate without a key), kIo (the port is in use, or the address is not of this machine),
  /// kNotFound, kParse and kState (the certificate or its key is unusable).
  [[nodiscard]] static Result<std::unique_ptr<Server>> start(const ServerOptions& options,
                                                             Handler& handler);
  virtual ~Server() = default;

  [[nodiscard]] virtual std::uint16_t port() const noexcept = 0;
  /// `http://127.0.0.1:8080`; with TLS the first name in the certificate. Any thread.
  [[nodiscard]] virtual std::string origin() const = 0;
  /// Server thread only.
  [[nodiscard]] virtual ServerCounts counts() const = 0;
  /// Calls a function on the thread of the server as soon as possible. Any thread.
  virtual void post(std::function<void()> call) = 0;
  /// Calls a function on the thread of the server periodically. Any thread.
  virtual void every(std::chrono::milliseconds period, std::function<void()> call) = 0;
  /// Calls a function on the thread of the server each time that a bell has rung, from now on;
  /// instead of the bell before. `descriptor`: of the bell, of which a copy is kept; negative:
  /// none. Server thread only.
  virtual void when_rung(int descriptor, std::function<void()> call) = 0;
  /// Closes all connections and ends the thread within two seconds. Idempotent; any thread but that
  /// of the server. The destructor calls it.
  virtual void stop() = 0;
};

}  // namespace rave::web
