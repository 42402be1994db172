// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/io_context.hpp>
#include <set>

#include "places.hpp"
#include "rave/web/rate_limit.hpp"
#include "rave/web/server.hpp"
#include "stream.hpp"
#include "tls.hpp"

namespace rave::web {

/// A WebSocket as seen by its server.
class SocketLink : public Socket {
 public:
  /// Closes it at once, without a handshake.
  virtual void cut() = 0;
  /// Called at regular times: pings a client that sent nothing since the last call, and cuts it off
  /// if it has not answered by the next one.
  virtual void check_heard() = 0;
};

/// The state common to the connections of a server. Thread: that of the server.
class Core {
 public:
  Core(const ServerOptions& options, Handler& handler);

  [[nodiscard]] const ServerOptions& options() const noexcept { return options_; }
  [[nodiscard]] Handler& handler() noexcept { return handler_; }
  [[nodiscard]] asio::io_context& io() noexcept { return io_; }
  [[nodiscard]] std::uint64_t next_id() noexcept { return ++last_id_; }
  [[nodiscard]] bool is_own_host(std::string_view host) const;
  /// `http://` or `https://`.
  [[nodiscard]] const char* scheme() const noexcept { return tls ? "https://" : "http://"; }
  /// Whether an address may open another connection now.
  [[nodiscard]] bool accepts_from(const std::string& address);
  /// Whether a request is within the limits.
  [[nodiscard]] bool takes_request(const Caller& caller, const std::string& address);

  std::unique_ptr<Tls> tls;  ///< Null: no TLS.
  RateLimit messages;        ///< By session.
  ServerCounts counts;
  std::uint16_t port = 0;
  bool stopping = false;
  ConnectionPlaces connections;
  SocketPlaces socket_places;
  std::set<SocketLink*> sockets;

 private:
  ServerOptions options_;
  Handler& handler_;
  RateLimit accepts_;          ///< By address.
  RateLimit network_accepts_;  ///< By network.
  RateLimit requests_;         ///< By session, or by network.
  asio::io_context io_{1};
  std::uint64_t last_id_ = 0;
};

/// Serves an accepted connection.
void serve_connection(Core& core, TcpSocket socket, const std::string& peer);

}  // namespace rave::web
