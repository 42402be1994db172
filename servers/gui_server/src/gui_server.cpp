// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/gui_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "entrance.hpp"
#include "rave/base/file.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/web/server.hpp"
#include "rave/web/static_files.hpp"
#include "session.hpp"

namespace rave::gui_server {
namespace {

constexpr auto kTick = std::chrono::milliseconds(16);
constexpr int kPortsToTry = 20;
constexpr std::uint16_t kNotSignedIn = 4401;

/// Cookies of several servers on one machine must not overwrite each other: browsers keep them by
/// host, whatever the port.
std::string cookie_name(std::uint16_t port) { return fmt::format("rave_{}", port); }

}  // namespace

class GuiServer::Impl final : public web::Handler {
 public:
  Impl(web::StaticFiles files, std::shared_ptr<Source> source)
      : files_(std::move(files)), source_(std::move(source)) {}
  ~Impl() override {
    if (server_) server_->stop();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Status listen(std::uint16_t port) {
    web::ServerOptions options;
    options.port = port;
    options.ports_to_try = kPortsToTry;
    options.subprotocol = "rave.gui.1";
    RAVE_TRY_ASSIGN(server_, web::Server::start(options, *this));
    server_->every(kTick, [this] { tick(); });
    return {};
  }

  void show(std::shared_ptr<Source> source) {
    server_->post([this, source = std::move(source)] {
      source_ = source;
      for (auto& [id, session] : sessions_) session->show(source_);
    });
  }

  [[nodiscard]] std::uint16_t port() const noexcept { return server_->port(); }
  [[nodiscard]] std::string entry() {
    return fmt::format("http://127.0.0.1:{}/enter?key={}", port(), entrance_.new_key());
  }

  web::Response serve(const web::Request& request) override {
    if (request.path == "/healthz") return web::text_response(200, "ok\n");
    if (request.path == "/enter") return enter(request);
    if (request.path == "/recording") return recording(request);
    return files_.serve(request);
  }

  Admission admit(const web::Request& request) override {
    if (signed_in(request)) return {};
    return {kNotSignedIn, "You are not signed in"};
  }

  void opened(std::uint64_t id, web::Socket& socket, const web::Request& /*request*/) override {
    Session& session =
        *sessions_.emplace(id, std::make_unique<Session>(socket, "you")).first->second;
    if (source_) session.show(source_);
  }
  void received(std::uint64_t id, std::string_view text) override {
    if (const auto found = sessions_.find(id); found != sessions_.end()) {
      found->second->received(text);
    }
  }
  void closed(std::uint64_t id) override { sessions_.erase(id); }

 private:
  [[nodiscard]] bool signed_in(const web::Request& request) const {
    return entrance_.knows(request.cookie(cookie_name(port())));
  }

  web::Response enter(const web::Request& request) {
    const auto key = request.query.find("key");
    const auto secret = key == request.query.end() ? std::nullopt : entrance_.enter(key->second);
    // Who is in already and follows the link again, as by "back", stays in.
    if (!secret && !signed_in(request)) {
      return web::text_response(403, "This link was used already, or is not one of this server.\n");
    }
    web::Response response;
    response.status = 303;
    response.headers.emplace_back("Location", "/");
    response.headers.emplace_back("Cache-Control", "no-store");
    if (secret) {
      response.headers.emplace_back(
          "Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict; Max-Age=604800",
                                    cookie_name(port()), *secret));
    }
    return response;
  }

  void tick() {
    if (!source_) return;
    const auto now = Session::Clock::now();
    Audience audience;
    for (const auto& [id, session] : sessions_) {
      const LookMessage& look = session->look();
      audience.any = audience.any || look.poses;
      audience.parts = audience.parts || look.parts;
      audience.looked_at.insert(audience.looked_at.end(), look.readings.begin(),
                                look.readings.end());
    }
    std::sort(audience.looked_at.begin(), audience.looked_at.end());
    audience.looked_at.erase(std::unique(audience.looked_at.begin(), audience.looked_at.end()),
                             audience.looked_at.end());
    source_->tick(now, audience);
    std::map<std::uint32_t, web::Payload> frames;
    for (auto& [id, session] : sessions_) session->tick(now, frames);
  }

  web::Response recording(const web::Request& request) {
    if (!signed_in(request)) return web::text_response(401, "not signed in\n");
    if (!source_) return web::text_response(404, "no run is in progress\n");
    const RunAbout& about = source_->about();
    if (about.recording.empty()) return web::text_response(404, "there is no recording\n");
    constexpr std::uint64_t kMostInMemory = std::uint64_t{256} << 20U;
    if (about.recording_bytes > kMostInMemory) {
      return web::text_response(413, fmt::format("Too large to download here; it lies at {}\n",
                                                 about.recording.string()));
    }
    auto content = read_file(about.recording);
    if (!content) return web::text_response(500, content.error().text() + "\n");
    web::Response response;
    response.type = "application/octet-stream";
    response.headers.emplace_back("Content-Disposition",
                                  fmt::format("attachment; filename=\"{}.mcap\"", about.name));
    response.body = std::make_shared<const std::string>(*std::move(content));
    return response;
  }

  web::StaticFiles files_;
  std::shared_ptr<Source> source_;  ///< Null: none yet. The thread of the server.
  Entrance entrance_;
  std::map<std::uint64_t, std::unique_ptr<Session>> sessions_;  ///< The thread of the server.
  std::unique_ptr<web::Server> server_;
};

GuiServer::GuiServer(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
GuiServer::~GuiServer() = default;

Result<std::unique_ptr<GuiServer>> GuiServer::start(const GuiOptions& options,
                                                    std::shared_ptr<Source> source) {
  auto files = web::StaticFiles::load(options.page);
  if (!files) {
    return fail(ErrorCode::kNotFound,
                "the page is missing: {}; with nodejs and npm installed, "
                "`ninja -C build/release rave_page` builds it",
                files.error().message);
  }
  auto impl = std::make_unique<Impl>(*std::move(files), std::move(source));
  RAVE_TRY(impl->listen(options.port));
  return std::unique_ptr<GuiServer>(new GuiServer(std::move(impl)));
}

void GuiServer::show(std::shared_ptr<Source> source) { impl_->show(std::move(source)); }
std::uint16_t GuiServer::port() const noexcept { return impl_->port(); }
std::string GuiServer::entry() { return impl_->entry(); }

}  // namespace rave::gui_server
