// SPDX-License-Identifier: Apache-2.0
// One of the two files that include Boost.Beast with its HTTP or WebSockets: each takes a gigabyte
// and half a minute to compile.
#include <fmt/format.h>

#include <algorithm>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <vector>

#include "websocket.hpp"

namespace rave::web {
namespace {

namespace http = beast::http;
using Message = http::request<http::string_body>;
using Answer = http::response<http::span_body<const char>>;

const std::string& policy() {
  static const std::string kPolicy = content_policy();
  return kPolicy;
}

/// The WebSocket path of pages; upgrade() handles others.
constexpr std::string_view kUsualSocket = "/ws";

/// Size of the pieces of a file.
constexpr std::size_t kPiece = std::size_t{256} << 10U;

/// A file that is being sent.
struct Outgoing {
  std::ifstream file;
  std::uint64_t left = 0;  ///< Bytes not read yet.
  std::vector<char> piece;
};

/// Null: the file cannot be read.
std::shared_ptr<Outgoing> open_outgoing(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return nullptr;
  auto outgoing = std::make_shared<Outgoing>();
  outgoing->file.open(path, std::ios::binary);
  outgoing->left = size;
  return outgoing->file ? outgoing : nullptr;
}

/// One connection before it becomes a WebSocket: a sequence of requests.
class Connection final : public Link, public std::enable_shared_from_this<Connection> {
 public:
  Connection(Core& core, TcpSocket socket, const std::string& peer)
      : core_(core),
        stream_(std::move(socket), core.tls ? &core.tls->context() : nullptr),
        peer_(peer) {
    core_.connections.add(*this, peer);
  }
  ~Connection() override { core_.connections.remove(*this); }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void begin();
  void cut() override {
    if (!handed_over_) stream_.close();
  }
  void answer(const Response& response);

 private:
  void read();
  void refuse_broken(Error error);
  void take();
  void dispatch(const Request& request);
  void refuse(const Response& response);
  void send(const std::shared_ptr<Answer>& reply, Payload body, bool without_body);
  void send_file(const std::shared_ptr<Answer>& reply, const std::shared_ptr<Outgoing>& outgoing);
  void send_piece(const std::shared_ptr<Answer>& reply, const std::shared_ptr<Outgoing>& outgoing);
  void sent(const Answer& reply);
  /// The refusal of a request before the handler sees it.
  [[nodiscard]] std::optional<Response> refusal(Request& request);
  void upgrade(Request request);

  Core& core_;
  Stream stream_;
  std::string peer_;
  Caller caller_;  ///< Of the last request.
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  Message message_;
  bool handed_over_ = false;
};

void Connection::begin() {
  // Also for the handshake: a client that says nothing holds a place.
  stream_.expires_after(core_.options().idle);
  stream_.handshake([self = shared_from_this()](Error error) {
    if (error) {
      ++self->core_.counts.failed_handshakes;
      return self->stream_.close();
    }
    self->read();
  });
}

void Connection::read() {
  parser_.emplace();
  parser_->header_limit(static_cast<std::uint32_t>(core_.options().request_bytes));
  parser_->body_limit(core_.options().request_bytes);
  stream_.expires_after(core_.options().idle);
  http::async_read(stream_, buffer_, *parser_,
                   [self = shared_from_this()](Error error, std::size_t) {
                     if (error) return self->refuse_broken(error);
                     self->take();
                   });
}

void Connection::refuse_broken(Error error) {
  const bool large = error == http::error::header_limit || error == http::error::body_limit;
  // What is no HTTP gets no answer.
  if (!large) return stream_.close();
  message_ = {};
  message_.keep_alive(false);
  message_.version(11);
  refuse(text_response(413, "the request is too large\n"));
}

void Connection::take() {
  ++core_.counts.requests;
  message_ = parser_->release();
  Request request;
  request.method = std::string(message_.method_string());
  for (const auto& field : message_) {
    std::string name(field.name_string());
    // Names of header fields are not case sensitive (RFC 9110, section 5.1).
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    request.headers.emplace(std::move(name), std::string(field.value()));
  }
  request.peer = peer_;
  if (const auto refused = refusal(request)) return refuse(*refused);
  if (beast::websocket::is_upgrade(message_)) return upgrade(std::move(request));
  request.body = std::move(message_.body());
  dispatch(request);
}

/// Releases a connection in the thread of the server, wherever the last copy of a reply is
/// destroyed.
class Held {
 public:
  Held(Core& core, std::shared_ptr<Connection> connection)
      : core_(core), connection_(std::move(connection)) {}
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() {
    asio::post(core_.io(), [connection = std::move(connection_)] {});
  }
  void answer(const Response& response) const {
    asio::post(core_.io(), [connection = connection_, response] { connection->answer(response); });
  }

 private:
  Core& core_;
  std::shared_ptr<Connection> connection_;  ///< Shared with pending operations.
};

void Connection::dispatch(const Request& request) {
  const auto held = std::make_shared<Held>(core_, shared_from_this());
  const Reply reply = [held](const Response& response) { held->answer(response); };
  // A later response has its own timeout; nothing is read meanwhile.
  stream_.expires_after(core_.options().idle);
  // Slow work is done elsewhere and answered later, because this thread serves all connections.
  if (core_.handler().serve_later(request, reply)) return;
  answer(core_.handler().serve(request));
}

std::optional<Response> Connection::refusal(Request& request) {
  const std::string target(message_.target());
  const bool known = parse_target(target, request.path, request.query);
  caller_ = known ? core_.handler().caller(request) : Caller();
  core_.connections.name(*this, caller_);
  if (!core_.takes_request(caller_, peer_)) {
    Response response = text_response(429, "too many requests; try again in a few seconds\n");
    response.headers.emplace_back("Retry-After", "5");
    return response;
  }
  if (!known) return text_response(400, "malformed request target\n");
  if (request.method != "GET" && request.method != "HEAD" && request.method != "POST") {
    return text_response(405, "method not allowed\n");
  }
  // A foreign name that resolves to this address would give foreign pages access to a server on
  // loopback (DNS rebinding).
  if (!core_.is_own_host(request.header("host"))) {
    return text_response(421, "this server does not have that name\n");
  }
  const std::string_view origin = request.header("origin");
  const bool socket = beast::websocket::is_upgrade(message_) && request.path == kUsualSocket;
  // A browser sends cookies with requests of foreign pages, too. What changes something, or opens a
  // socket, must come from a page of this server (cross-site request forgery).
  const bool writes = request.method == "POST" || socket;
  if (core_.options().own_origin_only && writes && !origin.empty() &&
      origin != fmt::format("{}{}", core_.scheme(), request.header("host"))) {
    return text_response(403, "requests of other origins are refused\n");
  }
  return std::nullopt;
}

void Connection::upgrade(Request request) {
  std::string subprotocol = core_.options().subprotocol;
  if (request.path != kUsualSocket) {
    Handler::Upgrade answer = core_.handler().upgrade(request);
    if (answer.refusal) return refuse(*answer.refusal);
    subprotocol = std::move(answer.subprotocol);
  }
  stream_.set_send_buffer(core_.options().send_buffer_bytes);
  // From here on the socket belongs to the WebSocket, and cut() must not close it.
  handed_over_ = true;
  core_.connections.remove(*this);
  serve_websocket(core_, std::move(stream_), std::move(caller_), std::move(request),
                  std::move(subprotocol), message_);
}

void Connection::refuse(const Response& response) {
  ++core_.counts.refused_requests;
  answer(response);
}

void Connection::answer(const Response& response) {
  std::shared_ptr<Outgoing> outgoing;
  if (!response.file.empty()) {
    outgoing = open_outgoing(response.file);
    if (!outgoing) return answer(text_response(404, "the file cannot be read\n"));
  }
  auto reply = std::make_shared<Answer>();
  reply->version(message_.version());
  reply->result(static_cast<unsigned>(response.status));
  reply->set(http::field::content_type, response.type);
  reply->set("Content-Security-Policy", policy());
  // Defaults for every answer: no guessing of types, no address of this page to others, no window
  // shared with other pages.
  reply->set("X-Content-Type-Options", "nosniff");
  reply->set("Referrer-Policy", "no-referrer");
  reply->set("Cross-Origin-Opener-Policy", "same-origin");
  // Thirty days, after which the machine may use plain HTTP again.
  if (core_.tls) reply->set("Strict-Transport-Security", "max-age=2592000");
  // A handler's header replaces the default; cookies may be repeated.
  for (const auto& [name, value] : response.headers) {
    if (name == "Set-Cookie") {
      reply->insert(name, value);
    } else {
      reply->set(name, value);
    }
  }
  const std::size_t size = response.body ? response.body->size() : 0;
  const bool without = message_.method() == http::verb::head || response.status == 304;
  if (response.body && !without) reply->body() = {response.body->data(), size};
  reply->keep_alive(message_.keep_alive());
  reply->content_length(outgoing ? outgoing->left : size);
  if (outgoing && !without) return send_file(reply, outgoing);
  send(reply, response.body, without);
}

void Connection::send_file(const std::shared_ptr<Answer>& reply,
                           const std::shared_ptr<Outgoing>& outgoing) {
  auto serializer =
      std::make_shared<http::response_serializer<http::span_body<const char>>>(*reply);
  stream_.expires_after(core_.options().idle);
  http::async_write_header(
      stream_, *serializer,
      [self = shared_from_this(), serializer, reply, outgoing](Error error, std::size_t) {
        if (error) return self->stream_.close();
        self->send_piece(reply, outgoing);
      });
}

/// The timeout applies to each piece: a slow connection may take long, a stalled one is closed.
void Connection::send_piece(const std::shared_ptr<Answer>& reply,
                            const std::shared_ptr<Outgoing>& outgoing) {
  if (outgoing->left == 0) return sent(*reply);
  outgoing->piece.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kPiece, outgoing->left)));
  outgoing->file.read(outgoing->piece.data(), static_cast<std::streamsize>(outgoing->piece.size()));
  if (!outgoing->file) return stream_.close();
  outgoing->left -= outgoing->piece.size();
  stream_.expires_after(core_.options().idle);
  asio::async_write(stream_, asio::buffer(outgoing->piece),
                    [self = shared_from_this(), reply, outgoing](Error error, std::size_t) {
                      if (error || self->core_.stopping) return self->stream_.close();
                      self->send_piece(reply, outgoing);
                    });
}

void Connection::sent(const Answer& reply) {
  if (reply.keep_alive() && !core_.stopping) return read();
  stream_.finish([self = shared_from_this()] {});
}

void Connection::send(const std::shared_ptr<Answer>& reply, Payload body, bool without_body) {
  const auto done = [self = shared_from_this(), reply, body = std::move(body)](Error error,
                                                                               std::size_t) {
    if (error) return self->stream_.close();
    self->sent(*reply);
  };
  stream_.expires_after(core_.options().idle);
  if (!without_body) return http::async_write(stream_, *reply, done);
  auto serializer =
      std::make_shared<http::response_serializer<http::span_body<const char>>>(*reply);
  http::async_write_header(
      stream_, *serializer,
      [serializer, done](Error error, std::size_t size_out) { done(error, size_out); });
}

}  // namespace

void serve_connection(Core& core, TcpSocket socket, const std::string& peer) {
  std::make_shared<Connection>(core, std::move(socket), peer)->begin();
}

}  // namespace rave::web
