// SPDX-License-Identifier: Apache-2.0
// One of the two files that include Boost.Beast with its HTTP or WebSockets: each takes a gigabyte
// and half a minute to compile.
#include "websocket.hpp"

#include <algorithm>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <optional>
#include <utility>

namespace rave::web {
namespace {

namespace http = beast::http;
namespace websocket = beast::websocket;

constexpr std::uint16_t kTooMany = 4429;
constexpr std::uint16_t kNoRoom = 4430;
/// Who does not answer a closing handshake within this time is cut off.
constexpr auto kClosing = std::chrono::seconds(3);

/// A WebSocket with its own queue. Lives as long as one of its operations is pending.
class WebSocket final : public SocketLink, public std::enable_shared_from_this<WebSocket> {
 public:
  WebSocket(Core& core, Stream stream, Caller caller, Request request, std::string subprotocol)
      : core_(core),
        stream_(std::move(stream)),
        caller_(std::move(caller)),
        request_(std::move(request)),
        no_room_(core.socket_places.refusal(caller_, request_.peer)),
        place_(core.socket_places, caller_, request_.peer),
        subprotocol_(std::move(subprotocol)),
        rate_(core.options().messages_per_s, core.options().message_burst) {}
  ~WebSocket() override { core_.sockets.erase(this); }
  WebSocket(const WebSocket&) = delete;
  WebSocket& operator=(const WebSocket&) = delete;

  void accept(const http::request<http::string_body>& upgrade);
  void send_text(Payload text) override { queue({std::move(text), true}); }
  void send_binary(Payload bytes) override { queue({std::move(bytes), false}); }
  void close(std::uint16_t code, std::string_view reason) override;
  [[nodiscard]] std::size_t waiting_bytes() const noexcept override { return waiting_; }
  void cut() override { stream_.next_layer().close(); }
  void check_heard() override;

 private:
  struct Out {
    Payload payload;
    bool text = false;
  };
  void opened();
  /// Whether another message is within the limits.
  [[nodiscard]] bool takes_message();
  void queue(Out out);
  void write();
  void read();
  void take(std::string_view message);
  void start_closing();
  void end();

  Core& core_;
  websocket::stream<Stream> stream_;
  Caller caller_;
  Request request_;
  std::string_view no_room_;  ///< Why; empty: there is room.
  SocketPlaces::Place place_;
  std::string subprotocol_;
  TokenBucket rate_;
  beast::flat_buffer buffer_;
  std::deque<Out> out_;
  std::size_t waiting_ = 0;
  std::uint64_t id_ = 0;
  std::optional<websocket::close_reason> closing_;
  bool writing_ = false;
  bool silent_ = false;   ///< At the last check.
  bool pinging_ = false;  ///< A ping is on its way to the kernel.
  bool ended_ = false;
};

void WebSocket::accept(const http::request<http::string_body>& upgrade) {
  const ServerOptions& options = core_.options();
  stream_.next_layer().expires_never();
  // Beast would set its idle timer anew with each message; one timer of the server checks all.
  stream_.set_option(
      websocket::stream_base::timeout{options.idle, websocket::stream_base::none(), false});
  stream_.read_message_max(options.message_bytes);
  // Messages are complete in memory; pieces would only cost headers.
  stream_.auto_fragment(false);
  if (!subprotocol_.empty()) {
    stream_.set_option(
        websocket::stream_base::decorator([this](websocket::response_type& response) {
          response.set(http::field::sec_websocket_protocol, subprotocol_);
        }));
  }
  stream_.async_accept(upgrade, [self = shared_from_this()](Error error) {
    if (!error && !self->core_.stopping) self->opened();
  });
}

void WebSocket::opened() {
  core_.sockets.insert(this);
  // Refused after the handshake, because a browser does not show a page why an upgrade failed; it
  // does show the code of a close.
  if (!no_room_.empty()) {
    ++core_.counts.sockets_without_room;
    core_.handler().crowded(request_, no_room_);
    close(kNoRoom, no_room_);
  } else if (const auto admission = core_.handler().admit(request_); admission.refusal != 0) {
    close(admission.refusal, admission.reason);
  } else {
    id_ = core_.next_id();
    core_.handler().opened(id_, *this, request_);
  }
  read();
}

void WebSocket::check_heard() {
  const bool was_silent = std::exchange(silent_, !stream_.next_layer().take_heard());
  if (!silent_ || ended_) return;
  if (was_silent) return cut();
  if (pinging_ || closing_) return;
  // Beast allows one ping at a time.
  pinging_ = true;
  stream_.async_ping({}, [self = shared_from_this()](Error) { self->pinging_ = false; });
}

void WebSocket::queue(Out out) {
  if (ended_ || closing_) return;
  // Payloads are shared by all pages that get them, so a frame for a hundred pages exists once.
  waiting_ += out.payload->size();
  out_.push_back(std::move(out));
  if (waiting_ > core_.options().waiting_bytes) {
    // A client that has not read for this long is cut off, because its queue costs memory.
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
  // One write at a time, as Beast requires; its handler begins the next one.
  writing_ = true;
  const Out& next = out_.front();
  stream_.text(next.text);
  stream_.async_write(asio::buffer(*next.payload),
                      [self = shared_from_this()](Error error, std::size_t) {
                        if (error) return self->end();
                        const std::size_t size = self->out_.front().payload->size();
                        self->waiting_ -= size;
                        self->core_.counts.sent_bytes += size;
                        self->out_.pop_front();
                        self->write();
                      });
}

void WebSocket::read() {
  stream_.async_read(buffer_, [self = shared_from_this()](Error error, std::size_t) {
    if (error) return self->end();
    const auto data = self->buffer_.cdata();
    self->take({static_cast<const char*>(data.data()), data.size()});
    self->buffer_.consume(data.size());
    self->read();
  });
}

void WebSocket::take(std::string_view message) {
  const bool text = stream_.got_text();
  // A page that was refused, or is being closed, is no longer heard.
  if (closing_ || id_ == 0) {
    if (!text) close(1003, "text messages only");
    return;
  }
  if (!takes_message()) {
    ++core_.counts.sockets_closed_for_rate;
    core_.handler().flooded(id_);
    return close(kTooMany, "too many messages");
  }
  if (text) return core_.handler().received(id_, message);
  // Pages send text only.
  if (!core_.handler().received_binary(id_, message)) close(1003, "text messages only");
}

bool WebSocket::takes_message() {
  const auto now = TokenBucket::Clock::now();
  if (!rate_.take(now)) return false;
  // The pages of a session share a limit, so that many of them are no way around that of one.
  const bool shared = !caller_.session.empty() && caller_.rank != Caller::Rank::kAlways;
  return !shared || core_.messages.take(caller_.session, now);
}

void WebSocket::close(std::uint16_t code, std::string_view reason) {
  if (ended_ || closing_) return;
  // A close frame has room for 123 bytes of reason (RFC 6455, section 5.5).
  constexpr std::size_t kMostReason = 120;
  closing_ = websocket::close_reason(
      static_cast<websocket::close_code>(code),
      beast::string_view(reason.data(), std::min(reason.size(), kMostReason)));
  // It takes no place of others while it closes. If too many do, by clients that do not answer, it
  // is cut; its pending read tells end().
  if (!place_.leave() && !core_.stopping) return cut();
  // Also while earlier messages wait for a client that does not read.
  stream_.next_layer().expires_after(kClosing);
  if (!writing_) start_closing();
}

void WebSocket::start_closing() {
  writing_ = true;
  stream_.async_close(*closing_, [self = shared_from_this()](Error) { self->end(); });
}

void WebSocket::end() {
  if (ended_) return;
  ended_ = true;
  out_.clear();
  waiting_ = 0;
  core_.sockets.erase(this);
  if (id_ != 0) core_.handler().closed(id_);
  cut();
}

}  // namespace

void serve_websocket(Core& core, Stream stream, Caller caller, Request request,
                     std::string subprotocol, const http::request<http::string_body>& upgrade) {
  std::make_shared<WebSocket>(core, std::move(stream), std::move(caller), std::move(request),
                              std::move(subprotocol))
      ->accept(upgrade);
}

}  // namespace rave::web
