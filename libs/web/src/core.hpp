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

/// Something that a server has open, and closes when it ends.
class Link {
 public:
  virtual ~Link() = default;
  /// Without ceremony.
  virtual void cut() = 0;
};

/// A WebSocket as its server sees it.
class SocketLink : public Socket {
 public:
  /// Without ceremony.
  virtual void cut() = 0;
};

/// What the connections of a server share. The thread of the server.
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
  /// Whether a network may have one connection more.
  [[nodiscard]] bool has_room(const std::string& network) const;

  std::unique_ptr<Tls> tls;  ///< Null: none.
  RateLimit accepts;         ///< As many as requests: a handshake of TLS costs more than they do.
  RateLimit requests;
  ServerCounts counts;
  std::uint16_t port = 0;
  bool stopping = false;
  std::set<SocketLink*> sockets;
  std::set<Link*> connections;
  std::map<std::string, std::size_t> seats;  ///< Connections and sockets by network.

 private:
  ServerOptions options_;
  Handler& handler_;
  asio::io_context io_{1};
  std::uint64_t last_id_ = 0;
};

/// Counts a connection as one of its network as long as it lives.
class Seat {
 public:
  Seat(Core& core, std::string network) : core_(core), network_(std::move(network)) {
    ++core_.seats[network_];
  }
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;
  ~Seat() {
    if (--core_.seats[network_] == 0) core_.seats.erase(network_);
  }
  [[nodiscard]] const std::string& network() const noexcept { return network_; }

 private:
  Core& core_;
  std::string network_;
};

/// Begins with a connection that was accepted: one request after the other.
void serve_connection(Core& core, Tcp::socket socket, const std::string& peer);

}  // namespace rave::web
