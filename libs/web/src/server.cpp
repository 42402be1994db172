// SPDX-License-Identifier: Apache-2.0
// The only file that includes Boost.Beast: it takes 2 GB and 40 s to compile.
#include "rave/web/server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <set>
#include <thread>

namespace rave::web {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using Tcp = asio::ip::tcp;
using Error = beast::error_code;

// `connect-src 'self'` keeps the page from telling anybody else; images of the page itself may be
// data. Styles are set by the docking library on elements, which needs 'unsafe-inline' for styles.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; img-src 'self' data: "
    "blob:; font-src 'self'; connect-src 'self'; manifest-src 'self'; worker-src 'self'; base-uri "
    "'none'; form-action 'self'; frame-ancestors 'none'";

class ServerImpl;

/// A WebSocket with a queue of its own. Lives as long as an operation of it is under way.
class WebSocket final : public Socket, public std::enable_shared_from_this<WebSocket> {
 public:
  WebSocket(ServerImpl& server, beast::tcp_stream stream, Request request)
      : server_(server), stream_(std::move(stream)), request_(std::move(request)) {}

  void accept(const http::request<http::string_body>& upgrade);
  void send_text(Payload text) override { queue({std::move(text), true}); }
  void send_binary(Payload bytes) override { queue({std::move(bytes), false}); }
  void close(std::uint16_t code, std::string_view reason) override;
  [[nodiscard]] std::size_t waiting_bytes() const noexcept override { return waiting_; }
  /// Without ceremony: the server ends.
  void cut();

 private:
  struct Out {
    Payload payload;
    bool text = false;
  };
  void queue(Out out);
  void write();
  void read();
  void start_closing();
  void end();

  ServerImpl& server_;
  websocket::stream<beast::tcp_stream> stream_;
  Request request_;
  beast::flat_buffer buffer_;
  std::deque<Out> out_;
  std::size_t waiting_ = 0;
  std::uint64_t id_ = 0;
  std::optional<websocket::close_reason> closing_;
  bool writing_ = false;
  bool ended_ = false;
};

/// One connection before it becomes a WebSocket: one request after the other.
class Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(ServerImpl& server, Tcp::socket socket)
      : server_(server), stream_(std::move(socket)) {}
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;
  void read();
  void cut() { stream_.close(); }

 private:
  void take();
  void answer(const Response& response);
  /// Why a request is refused before anybody looks at it.
  [[nodiscard]] std::optional<Response> refusal(Request& request) const;
  void upgrade(Request request);

  ServerImpl& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::request<http::string_body> message_;
};

class ServerImpl final : public Server {
 public:
  ServerImpl(const ServerOptions& options, Handler& handler)
      : options_(options), handler_(handler), acceptor_(io_) {}
  ~ServerImpl() override { stop(); }

  Status listen();
  void run() {
    thread_ = std::thread([this] { io_.run(); });
  }

  [[nodiscard]] std::uint16_t port() const noexcept override { return port_; }
  void post(std::function<void()> call) override { asio::post(io_, std::move(call)); }
  void every(std::chrono::milliseconds period, std::function<void()> call) override;
  void stop() override;

  [[nodiscard]] const ServerOptions& options() const noexcept { return options_; }
  [[nodiscard]] Handler& handler() noexcept { return handler_; }
  [[nodiscard]] asio::io_context& io() noexcept { return io_; }
  [[nodiscard]] bool stopping() const noexcept { return stopping_; }
  [[nodiscard]] std::uint64_t next_id() noexcept { return ++last_id_; }
  [[nodiscard]] bool is_own_host(std::string_view host) const;

  std::set<WebSocket*> sockets;
  std::set<Connection*> connections;

 private:
  struct Timer {
    asio::steady_timer timer;
    std::chrono::milliseconds period;
    std::function<void()> call;
  };
  void accept();
  void arm(const std::shared_ptr<Timer>& timer);

  ServerOptions options_;
  Handler& handler_;
  asio::io_context io_{1};
  Tcp::acceptor acceptor_;
  std::vector<std::shared_ptr<Timer>> timers_;  ///< Shared with the operation under way.
  std::thread thread_;
  std::uint16_t port_ = 0;
  std::uint64_t last_id_ = 0;
  bool stopping_ = false;  ///< Of the server's thread.
};

// --- WebSocket -----------------------------------------------------------------------------------

void WebSocket::accept(const http::request<http::string_body>& upgrade) {
  beast::get_lowest_layer(stream_).expires_never();
  websocket::stream_base::timeout timeout{server_.options().idle, server_.options().idle, true};
  stream_.set_option(timeout);
  stream_.read_message_max(server_.options().message_bytes);
  stream_.auto_fragment(false);
  if (!server_.options().subprotocol.empty()) {
    stream_.set_option(
        websocket::stream_base::decorator([this](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, server_.options().subprotocol);
        }));
  }
  stream_.async_accept(upgrade, [self = shared_from_this()](Error error) {
    if (error || self->server_.stopping()) return;
    self->server_.sockets.insert(self.get());
    const Handler::Admission admission = self->server_.handler().admit(self->request_);
    if (admission.refusal != 0) {
      self->close(admission.refusal, admission.reason);
      self->read();
      return;
    }
    self->id_ = self->server_.next_id();
    self->server_.handler().opened(self->id_, *self, self->request_);
    self->read();
  });
}

void WebSocket::queue(Out out) {
  if (ended_ || closing_) return;
  waiting_ += out.payload->size();
  out_.push_back(std::move(out));
  if (waiting_ > server_.options().waiting_bytes) {
    // Who does not read for so long is gone, or worse; others must not pay for it.
    cut();
    return;
  }
  if (!writing_) write();
}

void WebSocket::write() {
  if (out_.empty()) {
    writing_ = false;
    if (closing_) start_closing();
    return;
  }
  writing_ = true;
  const Out& next = out_.front();
  stream_.text(next.text);
  stream_.async_write(asio::buffer(*next.payload),
                      [self = shared_from_this()](Error error, std::size_t) {
                        if (error) return self->end();
                        self->waiting_ -= self->out_.front().payload->size();
                        self->out_.pop_front();
                        self->write();
                      });
}

void WebSocket::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
    if (error) return self->end();
    const auto data = self->buffer_.cdata();
    const std::string_view text(static_cast<const char*>(data.data()), data.size());
    // Pages send text alone; anything else is nobody we know.
    if (!self->stream_.got_text()) {
      self->close(1003, "text messages only");
    } else if (self->id_ != 0 && !self->closing_) {
      self->server_.handler().received(self->id_, text);
    }
    self->buffer_.consume(data.size());
    self->read();
  });
}

void WebSocket::close(std::uint16_t code, std::string_view reason) {
  if (ended_ || closing_) return;
  constexpr std::size_t kMostReason = 120;
  closing_ = websocket::close_reason(
      static_cast<websocket::close_code>(code),
      beast::string_view(reason.data(), std::min(reason.size(), kMostReason)));
  if (!writing_) start_closing();
}

void WebSocket::start_closing() {
  writing_ = true;
  stream_.async_close(*closing_, [self = shared_from_this()](Error) { self->end(); });
}

void WebSocket::cut() { beast::get_lowest_layer(stream_).close(); }

void WebSocket::end() {
  if (ended_) return;
  ended_ = true;
  out_.clear();
  waiting_ = 0;
  server_.sockets.erase(this);
  if (id_ != 0) server_.handler().closed(id_);
  beast::get_lowest_layer(stream_).close();
}

// --- Connection ----------------------------------------------------------------------------------

Connection::~Connection() { server_.connections.erase(this); }

void Connection::read() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(server_.options().request_bytes));
  parser_->body_limit(server_.options().request_bytes);
  stream_.expires_after(server_.options().idle);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](Error error, std::size_t) {
                     if (error == http::error::header_limit || error == http::error::body_limit) {
                       self->message_ = {};
                       self->message_.keep_alive(false);
                       self->message_.version(11);
                       return self->answer(text_response(413, "the request is too large\n"));
                     }
                     if (error) return;
                     self->take();
                   });
}

void Connection::take() {
  message_ = parser_->release();
  Request request;
  request.method = std::string(message_.method_string());
  for (const auto& field : message_) {
    std::string name(field.name_string());
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    request.headers.emplace(std::move(name), std::string(field.value()));
  }
  Error ignored;
  const auto peer = stream_.socket().remote_endpoint(ignored);
  request.peer = ignored ? std::string() : peer.address().to_string();
  if (auto refused = refusal(request)) return answer(*refused);
  if (websocket::is_upgrade(message_)) return upgrade(std::move(request));
  request.body = std::move(message_.body());
  answer(server_.handler().serve(request));
}

std::optional<Response> Connection::refusal(Request& request) const {
  const std::string target(message_.target());
  if (!parse_target(target, request.path, request.query)) {
    return text_response(400, "malformed request target\n");
  }
  if (request.method != "GET" && request.method != "HEAD" && request.method != "POST") {
    return text_response(405, "method not allowed\n");
  }
  // A name of somebody else that leads here is how foreign pages reach servers on loopback.
  if (!server_.is_own_host(request.header("host"))) {
    return text_response(421, "this server does not have that name\n");
  }
  const std::string_view origin = request.header("origin");
  const bool writes = request.method == "POST" || websocket::is_upgrade(message_);
  if (writes && !origin.empty() && origin != fmt::format("http://{}", request.header("host"))) {
    return text_response(403, "requests of other origins are refused\n");
  }
  return std::nullopt;
}

void Connection::upgrade(Request request) {
  if (request.path != "/ws") return answer(text_response(404, "not found\n"));
  stream_.socket().set_option(
      asio::socket_base::send_buffer_size(server_.options().send_buffer_bytes));
  stream_.socket().set_option(Tcp::no_delay(true));
  std::make_shared<WebSocket>(server_, std::move(stream_), std::move(request))->accept(message_);
}

void Connection::answer(const Response& response) {
  auto reply = std::make_shared<http::response<http::span_body<const char>>>();
  const auto body = response.body;
  reply->version(message_.version());
  reply->result(static_cast<unsigned>(response.status));
  reply->set(http::field::content_type, response.type);
  reply->set("Content-Security-Policy", kPolicy);
  reply->set("X-Content-Type-Options", "nosniff");
  reply->set("Referrer-Policy", "no-referrer");
  reply->set("Cross-Origin-Opener-Policy", "same-origin");
  for (const auto& [name, value] : response.headers) reply->insert(name, value);
  const std::size_t size = body ? body->size() : 0;
  const bool without = message_.method() == http::verb::head || response.status == 304;
  if (body && !without) reply->body() = {body->data(), size};
  reply->keep_alive(message_.keep_alive());
  reply->content_length(size);
  auto self = shared_from_this();
  const auto done = [self, reply, body](Error error, std::size_t) {
    if (error || !reply->keep_alive()) {
      Error ignored;
      self->stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
      return;
    }
    self->read();
  };
  stream_.expires_after(server_.options().idle);
  if (without) {
    auto serializer =
        std::make_shared<http::response_serializer<http::span_body<const char>>>(*reply);
    http::async_write_header(
        stream_, *serializer,
        [serializer, done](Error error, std::size_t size_out) { done(error, size_out); });
    return;
  }
  http::async_write(stream_, *reply, done);
}

// --- Server --------------------------------------------------------------------------------------

Status ServerImpl::listen() {
  Error error;
  const auto address = asio::ip::make_address(options_.address, error);
  if (error) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is not an IP address", options_.address);
  }
  for (int i = 0; i < std::max(options_.ports_to_try, 1); ++i) {
    const auto port = static_cast<std::uint16_t>(options_.port + (options_.port == 0 ? 0 : i));
    const Tcp::endpoint endpoint(address, port);
    error = {};
    acceptor_ = Tcp::acceptor(io_);
    if (acceptor_.open(endpoint.protocol(), error)) break;
    acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!acceptor_.bind(endpoint, error)) break;
    if (error != asio::error::address_in_use) break;
  }
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error) {
    return fail(ErrorCode::kIo, "cannot listen on {}:{}: {}", options_.address, options_.port,
                error.message());
  }
  port_ = acceptor_.local_endpoint().port();
  accept();
  return {};
}

void ServerImpl::accept() {
  acceptor_.async_accept([this](Error error, Tcp::socket socket) {
    if (error == asio::error::operation_aborted || stopping_) return;
    if (!error && connections.size() + sockets.size() < options_.connections) {
      auto connection = std::make_shared<Connection>(*this, std::move(socket));
      connections.insert(connection.get());
      connection->read();
    }
    accept();
  });
}

bool ServerImpl::is_own_host(std::string_view host) const {
  const std::string port = fmt::format(":{}", port_);
  if (host.ends_with(port)) host.remove_suffix(port.size());
  return host == "localhost" || host == "127.0.0.1" || host == "[::1]" || host == options_.address;
}

void ServerImpl::every(std::chrono::milliseconds period, std::function<void()> call) {
  auto timer = std::make_shared<Timer>(Timer{asio::steady_timer(io_), period, std::move(call)});
  post([this, timer] {
    timers_.push_back(timer);
    timer->timer.expires_after(timer->period);
    arm(timer);
  });
}

void ServerImpl::arm(const std::shared_ptr<Timer>& timer) {
  timer->timer.async_wait([this, timer](Error error) {
    if (error || stopping_) return;
    timer->call();
    // On a grid, unless it fell behind: what was missed is not made up for.
    const auto next = timer->timer.expiry() + timer->period;
    timer->timer.expires_at(std::max(next, std::chrono::steady_clock::now()));
    arm(timer);
  });
}

void ServerImpl::stop() {
  if (!thread_.joinable()) return;
  post([this] {
    stopping_ = true;
    Error ignored;
    acceptor_.close(ignored);
    for (const auto& timer : timers_) timer->timer.cancel();
    for (Connection* const connection : std::vector(connections.begin(), connections.end())) {
      connection->cut();
    }
    for (WebSocket* const socket : std::vector(sockets.begin(), sockets.end())) {
      socket->close(1001, "the server ends");
    }
    auto bound = std::make_shared<asio::steady_timer>(io_, std::chrono::seconds(1));
    bound->async_wait([this, bound](Error) {
      for (WebSocket* const socket : std::vector(sockets.begin(), sockets.end())) socket->cut();
      io_.stop();
    });
    if (sockets.empty()) bound->cancel();
  });
  thread_.join();
}

}  // namespace

Result<std::unique_ptr<Server>> Server::start(const ServerOptions& options, Handler& handler) {
  auto server = std::make_unique<ServerImpl>(options, handler);
  RAVE_TRY(server->listen());
  server->run();
  return std::unique_ptr<Server>(std::move(server));
}

}  // namespace rave::web
