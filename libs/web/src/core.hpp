// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <boost/asio/io_context.hpp>
#include <map>
#include <set>

#include "rave/web/rate_limit.hpp"
#include "rave/web/server.hpp"
#include "stream.hpp"
#include "tls.hpp"

namespace rave::web {

/// An open resource that the server closes when it ends.
class Link {
 public:
  virtual ~Link() = default;
  /// Closes it at once, without a handshake.
  virtual void cut() = 0;
};

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
  /// Whether a network may open another connection.
  [[nodiscard]] bool has_room(const std::string& network) const;

  std::unique_ptr<Tls> tls;  ///< Null: no TLS.
  RateLimit accepts;  ///< The limit of requests also applies to connections: a TLS handshake costs
                      ///< more than a request.
  RateLimit requests;
  ServerCounts counts;
  std::uint16_t port = 0;
  bool stopping = false;
  std::set<SocketLink*> sockets;
  std::set<Link*> connections;
  std::map<std::string, std::size_t> slots;  ///< Number of connections and sockets by network.

 private:
  ServerOptions options_;
  Handler& handler_;
  asio::io_context io_{1};
  std::uint64_t last_id_ = 0;
};

/// Counts a connection for its network during its lifetime.
class ConnectionSlot {
 public:
  ConnectionSlot(Core& core, std::string network) : core_(core), network_(std::move(network)) {
    ++core_.slots[network_];
  }
  ConnectionSlot(const ConnectionSlot&) = delete;
  ConnectionSlot& operator=(const ConnectionSlot&) = delete;
  ~ConnectionSlot() {
    if (--core_.slots[network_] == 0) core_.slots.erase(network_);
  }
  [[nodiscard]] const std::string& network() const noexcept { return network_; }

 private:
  Core& core_;
  std::string network_;
};

/// Serves an accepted connection.
void serve_connection(Core& core, TcpSocket socket, const std::string& peer);

}  // namespace rave::web
