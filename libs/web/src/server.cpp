// SPDX-License-Identifier: Apache-2.0
// One thread serves all connections. Others hand it work with post().
#include "rave/web/server.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>
#include <thread>

#include "core.hpp"
#include "rave/base/thread.hpp"

namespace rave::web {

Core::Core(const ServerOptions& options, Handler& handler)
    : messages(4 * options.messages_per_s, 4 * options.message_burst),
      connections(options.connections, options.connections_per_session),
      socket_places(options),
      options_(options),
      handler_(handler),
      accepts_(options.accepts_per_s, options.accept_burst),
      network_accepts_(3 * options.accepts_per_s, 3 * options.accept_burst),
      requests_(options.requests_per_s, options.request_burst) {}

bool Core::is_own_host(std::string_view host) const {
  const std::string suffix = fmt::format(":{}", port);
  if (host.ends_with(suffix)) host.remove_suffix(suffix.size());
  // After DNS rebinding a browser still sends the foreign name, so these names are safe.
  if (host == "localhost" || host == "127.0.0.1" || host == "[::1]") return true;
  return tls ? tls->fits(std::string(host)) : host == options_.address;
}

bool Core::accepts_from(const std::string& address) {
  // All of this machine share an address, so that one of them could keep out the others.
  if (is_loopback(address)) return true;
  const auto now = RateLimit::Clock::now();
  return accepts_.take(address, now) && network_accepts_.take(network_of(address), now);
}

bool Core::takes_request(const Caller& caller, const std::string& address) {
  if (caller.cheap) return true;
  // Addresses have no blank, so none is taken for a session.
  const std::string of = caller.session.empty() ? network_of(address) : "session " + caller.session;
  return requests_.take(of, RateLimit::Clock::now());
}

namespace {

class ServerImpl final : public Server {
 public:
  ServerImpl(const ServerOptions& options, Handler& handler)
      : core_(options, handler), acceptor_(core_.io()) {}
  ~ServerImpl() override { stop(); }

  Status listen();
  [[nodiscard]] Status run() {
    return start_thread(thread_, "the web server", [this] { core_.io().run(); });
  }

  [[nodiscard]] std::uint16_t port() const noexcept override { return core_.port; }
  [[nodiscard]] std::string origin() const override;
  [[nodiscard]] ServerCounts counts() const override;
  void post(std::function<void()> call) override { asio::post(core_.io(), std::move(call)); }
  void every(std::chrono::milliseconds period, std::function<void()> call) override;
  void when_rung(int descriptor, std::function<void()> call) override;
  void stop() override;

 private:
  struct Timer {
    asio::steady_timer timer;
    std::chrono::milliseconds period;
    std::function<void()> call;
  };
  struct Bell {
    asio::posix::stream_descriptor descriptor;
    std::function<void()> call;
    std::uint64_t rung = 0;
  };
  void accept();
  void arm(const std::shared_ptr<Timer>& timer);
  void hear(const std::shared_ptr<Bell>& bell);

  Core core_;
  Tcp::acceptor acceptor_;
  std::vector<std::shared_ptr<Timer>> timers_;  ///< Shared with the pending operation.
  std::shared_ptr<Bell> bell_;                  ///< As above; null: none.
  std::thread thread_;
};

Status ServerImpl::listen() {
  const ServerOptions& options = core_.options();
  if (options.certificate.empty() != options.key.empty()) {
    return fail(ErrorCode::kInvalidArgument, "TLS needs a certificate and its key");
  }
  if (!options.certificate.empty()) {
    RAVE_TRY_ASSIGN(core_.tls, Tls::load(options.certificate, options.key));
  }
  Error error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not an IP address", options.address);
  }
  for (int i = 0; i < std::max(options.ports_to_try, 1); ++i) {
    const auto port = static_cast<std::uint16_t>(options.port + (options.port == 0 ? 0 : i));
    const Tcp::endpoint endpoint(address, port);
    error = {};
    acceptor_ = Tcp::acceptor(core_.io());
    if (acceptor_.open(endpoint.protocol(), error)) break;
    // A server that is started again can use its port at once; a port in use is refused all the
    // same.
    acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!acceptor_.bind(endpoint, error)) break;
    if (error != asio::error::address_in_use) break;
  }
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    return fail(ErrorCode::kIo, "cannot listen on {}:{}: {}", options.address, options.port,
                error.message());
  }
  core_.port = acceptor_.local_endpoint().port();
  accept();
  // A socket is silent after one whole period, and cut off after the next.
  every(std::chrono::milliseconds(options.idle) / 3, [this] {
    for (SocketLink* const socket : std::vector(core_.sockets.begin(), core_.sockets.end())) {
      socket->check_heard();
    }
  });
  return {};
}

void ServerImpl::accept() {
  acceptor_.async_accept(core_.io(), [this](Error error, TcpSocket socket) {
    if (error == asio::error::operation_aborted || core_.stopping) return;
    Error gone;
    const auto peer = error ? Tcp::endpoint() : socket.remote_endpoint(gone);
    const std::string address = peer.address().to_string();
    // Refused without an answer: it would cost as much as a request.
    if (!error && !gone && core_.accepts_from(address)) {
      ++core_.counts.connections;
      serve_connection(core_, std::move(socket), address);
    }
    accept();
  });
}

std::string ServerImpl::origin() const {
  std::string host = core_.tls ? core_.tls->names().front() : core_.options().address;
  if (host.find(':') != std::string::npos) host = "[" + host + "]";
  return fmt::format("{}{}:{}", core_.scheme(), host, core_.port);
}

ServerCounts ServerImpl::counts() const {
  ServerCounts counts = core_.counts;
  counts.open_connections = core_.connections.size();
  counts.open_sockets = core_.sockets.size();
  return counts;
}

void ServerImpl::every(std::chrono::milliseconds period, std::function<void()> call) {
  auto timer =
      std::make_shared<Timer>(Timer{asio::steady_timer(core_.io()), period, std::move(call)});
  // In the thread of the server, which owns the list of timers.
  post([this, timer] {
    timers_.push_back(timer);
    timer->timer.expires_after(timer->period);
    arm(timer);
  });
}

void ServerImpl::arm(const std::shared_ptr<Timer>& timer) {
  timer->timer.async_wait([this, timer](Error error) {
    if (error || core_.stopping) return;
    timer->call();
    // At regular times, unless it is behind: missed calls are skipped.
    const auto next = timer->timer.expiry() + timer->period;
    timer->timer.expires_at(std::max(next, std::chrono::steady_clock::now()));
    arm(timer);
  });
}

void ServerImpl::when_rung(int descriptor, std::function<void()> call) {
  if (bell_) bell_->descriptor.cancel();
  bell_.reset();
  const int copy = descriptor < 0 ? -1 : ::fcntl(descriptor, F_DUPFD_CLOEXEC, 0);
  if (copy < 0) return;
  bell_ = std::make_shared<Bell>(
      Bell{asio::posix::stream_descriptor(core_.io(), copy), std::move(call)});
  hear(bell_);
}

void ServerImpl::hear(const std::shared_ptr<Bell>& bell) {
  bell->descriptor.async_read_some(asio::buffer(&bell->rung, sizeof bell->rung),
                                   [this, bell](Error error, std::size_t) {
                                     if (error || core_.stopping || bell != bell_) return;
                                     bell->call();
                                     hear(bell);
                                   });
}

void ServerImpl::stop() {
  if (!thread_.joinable()) return;
  post([this] {
    core_.stopping = true;
    Error ignored;
    acceptor_.close(ignored);
    for (const auto& timer : timers_) timer->timer.cancel();
    when_rung(-1, {});
    for (Link* const link : core_.connections.all()) link->cut();
    for (SocketLink* const socket : std::vector(core_.sockets.begin(), core_.sockets.end())) {
      socket->close(1001, "the server is shutting down");
    }
    // Sockets get a second for their closing handshake.
    auto bound = std::make_shared<asio::steady_timer>(core_.io(), std::chrono::seconds(1));
    bound->async_wait([this, bound](Error) {
      for (SocketLink* const socket : std::vector(core_.sockets.begin(), core_.sockets.end())) {
        socket->cut();
      }
      core_.io().stop();
    });
    // A cancelled timer calls its handler, too, which ends the loop.
    if (core_.sockets.empty()) bound->cancel();
  });
  thread_.join();
}

}  // namespace

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options, Handler& handler) {
  auto server = std::make_unique<ServerImpl>(options, handler);
  RAVE_TRY(server->listen());
  RAVE_TRY(server->run());
  return std::unique_ptr<Server>(std::move(server));
}

}  // namespace rave::web
