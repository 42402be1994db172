// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/gui_server.hpp"

#include <fmt/format.h>

#include <chrono>

#include "foxglove/foxglove_door.hpp"
#include "foxglove/foxglove_guests.hpp"
#include "listen_rules.hpp"
#include "metrics.hpp"
#include "people/door.hpp"
#include "people/link_file.hpp"
#include "rave/base/file.hpp"
#include "rave/gui_server/conductor.hpp"
#include "rave/gui_server/source.hpp"
#include "rave/web/rate_limit.hpp"
#include "rave/web/server.hpp"
#include "rave/web/static_files.hpp"
#include "run/components.hpp"
#include "visitors/ticket_desk.hpp"
#include "visitors/visitors.hpp"

namespace rave::gui_server {
namespace {

/// How often pages of a recording are served.
constexpr auto kTick = std::chrono::milliseconds(16);
/// After so long, some beats of kTick, also those of a run whose bell has not rung.
constexpr auto kSilence = std::chrono::milliseconds(32);
constexpr auto kCheck = std::chrono::milliseconds(500);
constexpr int kPortsToTry = 20;
constexpr std::uint16_t kNotSignedIn = 4401;

}  // namespace

class GuiServer::Impl final : public web::Handler {
 public:
  struct Parts {
    web::StaticFiles files;
    std::shared_ptr<Accounts> accounts;
    std::shared_ptr<AuditLog> audit;
    RightsDesk desk;
    std::string metrics_token;
  };
  Impl(Parts parts, const GuiOptions& options)
      : files_(std::move(parts.files)),
        audit_(parts.audit),
        metrics_token_(std::move(parts.metrics_token)),
        door_({parts.accounts, parts.audit, !options.certificate.empty()}),
        visitors_(door_, std::move(parts.desk), parts.accounts, parts.audit,
                  [this](std::function<void()> call) { server_->post(std::move(call)); }),
        tickets_(parts.audit),
        foxglove_(options.foxglove),
        foxglove_door_(door_, parts.audit, options.foxglove_origins),
        guests_(door_, visitors_) {
    visitors_.offer_foxglove(foxglove_);
    // Elsewhere the address would be that of a super-user on everybody's network.
    if (foxglove_ && web::is_loopback(options.listen)) {
      foxglove_token_ = foxglove_door_.token_of(door_.new_session());
    }
  }
  ~Impl() override {
    // In this order: after stop() no request comes, and then the door waits for its work.
    if (server_) server_->stop();
    // What it still works at answers through the server, which is there until then.
    door_.stop();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Status listen(const GuiOptions& options, std::shared_ptr<Source> source) {
    web::ServerOptions web_options;
    web_options.address = options.listen;
    web_options.port = options.port;
    web_options.certificate = options.certificate;
    web_options.key = options.key;
    web_options.ports_to_try = kPortsToTry;
    // The number is that of the protocol of the page.
    web_options.subprotocol = "rave.gui.1";
    RAVE_TRY_ASSIGN(server_, web::Server::start(web_options, *this));
    // Only now the port is known: the one that was asked for may be in use. On the thread of the
    // server, which owns the door.
    server_->post([this, port = server_->port()] { door_.set_port(port); });
    if (source) show(std::move(source));
    server_->every(kTick, [this] {
      const auto& shown = visitors_.source();
      const bool rings = shown && shown->bell() >= 0;
      if (!rings || std::chrono::steady_clock::now() - ticked_ >= kSilence) tick();
    });
    server_->every(kCheck, [this] {
      visitors_.check();
      guests_.check();
      foxglove_door_.check();
      tickets_.check([this](const std::string& session) { return rights_of(session); });
    });
    return {};
  }

  void show(std::shared_ptr<Source> source) {
    server_->post([this, source = std::move(source)] {
      server_->when_rung(source->bell(), [this] { tick(); });
      visitors_.show(source);
      guests_.show();
    });
  }

  void conduct_by(std::shared_ptr<Conductor> conductor) {
    server_->post([this, conductor = std::move(conductor)] {
      tickets_.expect_lines_at(server_->origin());
      visitors_.conduct_by(conductor);
    });
  }
  void offer_lines(std::shared_ptr<direct_line::Lines> lines, const direct_line::SigningKey& key) {
    server_->post([this, lines = std::move(lines), key] { tickets_.offer(lines, key); });
  }

  [[nodiscard]] std::uint16_t port() const noexcept { return server_->port(); }
  [[nodiscard]] std::string origin() const { return server_->origin(); }
  [[nodiscard]] std::string entry() {
    return fmt::format("{}/enter?key={}", server_->origin(), door_.new_key());
  }

  [[nodiscard]] Result<std::filesystem::path> entry_file(const std::filesystem::path& folder) {
    // By port, of which a machine has each once.
    const std::string name = fmt::format("rave-page-{}.html", server_->port());
    RAVE_TRY_ASSIGN(auto file, LinkFile::write(folder, name, entry()));
    link_file_ = std::move(file);
    return link_file_->path();
  }

  [[nodiscard]] std::string foxglove_address() const {
    if (!foxglove_) return {};
    if (foxglove_token_.empty()) return server_->origin() + "/foxglove";
    return socket_address(foxglove_token_);
  }

  web::Caller caller(const web::Request& request) override {
    web::Caller caller;
    caller.cheap = Door::is_door(request);
    caller.session =
        is_guest(request) ? foxglove_door_.session_of(request) : door_.session_of(request);
    const auto person = door_.whose(caller.session);
    if (!person) {
      caller.session.clear();
      return caller;
    }
    caller.user = person->name;
    const bool always = person->role == Role::kSuperUser;
    const bool may_stop = visitors_.may_stop(*person);
    caller.rank = always     ? web::Caller::Rank::kAlways
                  : may_stop ? web::Caller::Rank::kMayStop
                             : web::Caller::Rank::kAnyone;
    return caller;
  }

  void crowded(const web::Request& request, std::string_view why) override {
    const std::string user = caller(request).user;
    audit_->note("refused", {{"why", why}, {"user", user}, {"from", request.peer}});
  }

  bool serve_later(const web::Request& request, const web::Reply& reply) override {
    return door_.serve_later(request, reply);
  }

  web::Response serve(const web::Request& request) override {
    // Both are asked for by monitoring, which does not sign in; the second has a token of its own.
    if (request.path == "/healthz") return web::text_response(200, "ok\n");
    if (request.path == "/metrics") return metrics(request);
    if (auto answer = door_.serve(request)) return *std::move(answer);
    // Before the refusal of POST: this is the one other path that takes it.
    if (request.path == "/ticket") return ticket(request);
    // Forms were answered by the door.
    if (request.method == "POST") return web::text_response(405, "method not allowed\n");
    if (request.path == "/recording") return recording(request);
    if (request.path == "/foxglove" && foxglove_) return foxglove_page(request);
    if (request.path.starts_with("/components/")) return component(request);
    web::Response file = files_.serve(request);
    if (request.path == "/" || request.path == "/index.html") {
      // Direct lines are the only other servers that the page may connect to.
      file.headers.emplace_back("Content-Security-Policy", web::content_policy(tickets_.ends()));
    }
    return file;
  }

  Upgrade upgrade(const web::Request& request) override {
    if (foxglove_ && request.path == "/foxglove") return foxglove_door_.upgrade(request);
    return Handler::upgrade(request);
  }

  Admission admit(const web::Request& request) override {
    const auto person =
        is_guest(request) ? door_.whose(foxglove_door_.session_of(request)) : door_.who(request);
    if (person) return {};
    // A close code rather than a refused upgrade, of which a script in a browser learns no reason.
    return {kNotSignedIn, "You are not signed in"};
  }

  void opened(std::uint64_t id, web::Socket& socket, const web::Request& request) override {
    if (is_guest(request)) {
      guests_.opened(id, socket, foxglove_door_.session_of(request));
    } else {
      visitors_.opened(id, socket, door_.session_of(request));
    }
  }
  void received(std::uint64_t id, std::string_view text) override {
    if (guests_.has(id)) return guests_.received(id, text);
    visitors_.received(id, text);
  }
  bool received_binary(std::uint64_t id, std::string_view /*bytes*/) override {
    if (!guests_.has(id)) return false;
    guests_.received_binary(id);
    return true;
  }
  void flooded(std::uint64_t id) override {
    if (!guests_.has(id)) return visitors_.flooded(id);
    audit_->note("cut_off",
                 {{"why", "too many messages of Foxglove"}, {"user", guests_.user_of(id)}});
  }
  void closed(std::uint64_t id) override {
    if (guests_.has(id)) return guests_.closed(id);
    visitors_.closed(id);
  }

 private:
  void tick() {
    ticked_ = std::chrono::steady_clock::now();
    visitors_.tick(guests_.audience());
    guests_.tick();
  }

  /// Other paths than that of pages were let through by upgrade().
  [[nodiscard]] static bool is_guest(const web::Request& request) {
    return request.path == "/foxglove";
  }

  [[nodiscard]] std::string socket_address(const std::string& token) const {
    // `http://...` becomes `ws://...`, and `https://...` `wss://...`.
    const std::string origin = server_->origin();
    return "ws" + origin.substr(std::string_view("http").size()) + "/foxglove?token=" + token;
  }

  /// Where a person who is signed in gets their address.
  web::Response foxglove_page(const web::Request& request) {
    const auto person = door_.who(request);
    if (!person) return web::text_response(401, "sign in at / first\n");
    const std::string token = foxglove_door_.token_of(door_.session_of(request));
    web::Response response = web::text_response(
        200, fmt::format("In Foxglove or Lichtblick: open a connection, Foxglove WebSocket, to\n\n"
                         "    {}\n\n"
                         "It shows what {} may see, and ends when you sign out. Keep it secret.\n",
                         socket_address(token), person->name));
    response.headers.emplace_back("Cache-Control", "no-store");
    return response;
  }

  web::Response metrics(const web::Request& request) {
    if (!may_read_metrics(request, metrics_token_)) {
      audit_->note("refused", {{"why", "metrics"}, {"from", request.peer}});
      return web::text_response(401, "the token of the server is missing\n");
    }
    web::Response response = web::text_response(
        200, metrics_text(server_->counts(), visitors_.count() + guests_.count(), audit_->lost()));
    response.type = "text/plain; version=0.0.4; charset=utf-8";
    return response;
  }

  /// What a session may now, for its tickets.
  std::optional<std::string> rights_of(const std::string& session) {
    const auto person = door_.whose(session);
    const auto view = person ? visitors_.view_of(*person) : nullptr;
    // A direct line bypasses this server, so nothing would hold it to the rights of the person
    // whose eyes are used.
    if (!view || visitors_.sees_as_other(session)) return std::nullopt;
    return TicketDesk::rights_of(*person, *view);
  }

  web::Response ticket(const web::Request& request) {
    if (request.method != "POST") return web::text_response(405, "only POST gives tickets\n");
    const auto person = door_.who(request);
    if (!person) return web::text_response(401, "not signed in\n");
    const auto view = visitors_.view_of(*person);
    if (!view || !visitors_.source()->about().live) {
      return web::text_response(404, "no run is in progress\n");
    }
    const std::string session = door_.session_of(request);
    if (visitors_.sees_as_other(session)) {
      return web::text_response(403, "you are viewing the page as another user\n");
    }
    return tickets_.serve(
        request, {Visitors::known(*person), session, view, visitors_.source()->about().relay});
  }

  /// What a user may not have does not exist for them (404).
  web::Response component(const web::Request& request) {
    const auto person = door_.who(request);
    if (!person) return web::text_response(401, "not signed in\n");
    const auto& source = visitors_.source();
    const PageComponent* const known =
        source ? component_at(source->components(), request.path) : nullptr;
    if (known == nullptr || !known->is_for(person->role)) {
      return web::text_response(404, "not found\n");
    }
    auto content = read_component(*known);
    if (!content) return web::text_response(500, content.error().text() + "\n");
    web::Response response;
    response.type = "text/javascript; charset=utf-8";
    response.headers.emplace_back("Cache-Control", "no-store");
    response.body = std::make_shared<const std::string>(*std::move(content));
    return response;
  }

  web::Response recording(const web::Request& request) {
    const auto person = door_.who(request);
    if (!person) return web::text_response(401, "not signed in\n");
    const auto view = visitors_.view_of(*person);
    if (!view) return web::text_response(404, "no run is in progress\n");
    // A recording cannot be cut down, so who may not see all of it gets nothing.
    if (!view->may_all(InfoClass::kRecording)) {
      audit_->note("refused",
                   {{"why", "recording"}, {"user", person->name}, {"from", request.peer}});
      return web::text_response(403, "Your rights do not include the recording.\n");
    }
    const RunAbout& about = visitors_.source()->about();
    if (about.recording.empty()) return web::text_response(404, "there is no recording\n");
    audit_->note("recording", {{"user", person->name}, {"from", request.peer}});
    web::Response response;
    response.type = "application/octet-stream";
    response.headers.emplace_back("Content-Disposition",
                                  fmt::format("attachment; filename=\"{}.mcap\"", about.name));
    response.file = about.recording;
    return response;
  }

  web::StaticFiles files_;
  std::shared_ptr<AuditLog> audit_;
  std::string metrics_token_;
  Door door_;
  Visitors visitors_;
  TicketDesk tickets_;
  bool foxglove_;
  FoxgloveDoor foxglove_door_;
  FoxgloveGuests guests_;
  std::chrono::steady_clock::time_point ticked_{};
  std::string foxglove_token_;  ///< Of a super-user; empty: there is none.
  std::optional<LinkFile> link_file_;
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
  std::shared_ptr<Accounts> accounts;
  std::string token;
  if (!options.accounts.empty()) {
    RAVE_TRY_ASSIGN(accounts, Accounts::open(options.accounts));
    RAVE_TRY_ASSIGN(token, metrics_token(options.accounts));
  }
  RAVE_TRY(check_listen(options, accounts.get()));
  for (const std::string& listed : options.foxglove_origins) {
    RAVE_TRY(check_foxglove_origin(listed));
  }
  RAVE_TRY_ASSIGN(RightsDesk desk, RightsDesk::open(options.accounts));
  auto impl = std::make_unique<Impl>(
      Impl::Parts{*std::move(files), accounts, std::make_shared<AuditLog>(options.accounts),
                  std::move(desk), std::move(token)},
      options);
  RAVE_TRY(impl->listen(options, std::move(source)));
  // For the links of `rave people invite`.
  if (accounts) {
    RAVE_TRY(write_private_file_atomically(options.accounts / "address", impl->origin() + "\n"));
  }
  return std::unique_ptr<GuiServer>(new GuiServer(std::move(impl)));
}

void GuiServer::show(std::shared_ptr<Source> source) { impl_->show(std::move(source)); }
void GuiServer::conduct_by(std::shared_ptr<Conductor> conductor) {
  impl_->conduct_by(std::move(conductor));
}
void GuiServer::offer_lines(std::shared_ptr<direct_line::Lines> lines,
                            const direct_line::SigningKey& key) {
  impl_->offer_lines(std::move(lines), key);
}
std::uint16_t GuiServer::port() const noexcept { return impl_->port(); }
std::string GuiServer::entry() { return impl_->entry(); }
Result<std::filesystem::path> GuiServer::entry_file(const std::filesystem::path& folder) {
  return impl_->entry_file(folder);
}
std::string GuiServer::foxglove_address() const { return impl_->foxglove_address(); }

}  // namespace rave::gui_server
