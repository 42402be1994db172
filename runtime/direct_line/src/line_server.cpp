// SPDX-License-Identifier: Apache-2.0
#include "rave/direct_line/line_server.hpp"

#include <fmt/format.h>

#include <future>

#include "explain_page.hpp"
#include "line_book.hpp"
#include "rave/web/rate_limit.hpp"
#include "rave/web/server.hpp"

namespace rave::direct_line {
namespace {

/// How often answers of the run are passed on, and lines are checked.
constexpr auto kPoll = std::chrono::milliseconds(5);
constexpr auto kLook = std::chrono::milliseconds(250);

Status check_address(const LineOptions& options) {
  if (web::is_loopback(options.address) || !options.certificate.empty()) return {};
  return fail(ErrorCode::kInvalidArgument,
              "a direct line on {} needs TLS: `rave keys web web-keys NAME`, with the name or "
              "address of this machine, makes a certificate; then add --certificate "
              "web-keys/server.pem --key web-keys/server_key.pem",
              options.address);
}

}  // namespace

class LineServer::Impl final : public web::Handler {
 public:
  Impl(const LineOptions& options, runtime::RunControl& control)
      : host_(options.host), book_(options, control) {}
  ~Impl() override {
    if (!server_) return;
    // Before the sockets are closed: stopping the robots must not wait for a page that does not
    // answer.
    std::promise<void> done;
    server_->post([this, &done] {
      book_.end();
      done.set_value();
    });
    done.get_future().wait();
    server_->stop();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Status listen(const LineOptions& options) {
    web::ServerOptions web_options;
    web_options.address = options.address;
    web_options.port = options.port;
    web_options.certificate = options.certificate;
    web_options.key = options.key;
    web_options.subprotocol = "rave.line.1";
    // The book has limits by ticket, which the server cannot know; strangers are beside these.
    web_options.sockets = 2 * LineBook::kMostLines;
    web_options.sockets_per_address = web_options.sockets_per_network = web_options.sockets;
    // The origin is checked by the ticket, which names that of its page.
    web_options.message_bytes = kLongestTicket + (std::size_t{16} << 10U);
    web_options.own_origin_only = false;
    RAVE_TRY_ASSIGN(server_, web::Server::start(web_options, *this));
    server_->every(kPoll, [this] { book_.poll(); });
    server_->every(kLook, [this] { book_.look_around(); });
    return {};
  }

  [[nodiscard]] web::Server& server() const noexcept { return *server_; }
  void withdraw(std::string signed_text) {
    server_->post([this, text = std::move(signed_text)] { book_.withdraw(text); });
  }
  web::Response serve(const web::Request& request) override {
    if (request.method == "POST") return web::text_response(405, "method not allowed\n");
    if (request.path == "/healthz") return web::text_response(200, "ok\n");
    if (request.path == "/") return explain_page(host_);
    return web::text_response(404, "not found\n");
  }
  Admission admit(const web::Request& /*request*/) override { return {}; }
  void opened(std::uint64_t id, web::Socket& socket, const web::Request& request) override {
    book_.opened(id, socket, request);
  }
  void received(std::uint64_t id, std::string_view text) override { book_.received(id, text); }
  void flooded(std::uint64_t id) override { book_.flooded(id); }
  void closed(std::uint64_t id) override { book_.closed(id); }

 private:
  std::string host_;
  LineBook book_;
  std::unique_ptr<web::Server> server_;
};

LineServer::LineServer(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
LineServer::~LineServer() = default;

Result<std::unique_ptr<LineServer>> LineServer::start(const LineOptions& options,
                                                      runtime::RunControl& control) {
  RAVE_TRY(check_address(options));
  auto impl = std::make_unique<Impl>(options, control);
  RAVE_TRY(impl->listen(options));
  return std::unique_ptr<LineServer>(new LineServer(std::move(impl)));
}

std::string LineServer::url() const {
  // `http://...` becomes `ws://...`, and `https://...` `wss://...`.
  return "ws" + impl_->server().origin().substr(std::string_view("http").size()) + "/ws";
}

std::uint16_t LineServer::port() const noexcept { return impl_->server().port(); }
void LineServer::withdraw(std::string signed_text) { impl_->withdraw(std::move(signed_text)); }

}  // namespace rave::direct_line
