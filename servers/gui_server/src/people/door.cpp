// SPDX-License-Identifier: Apache-2.0
#include "people/door.hpp"

#include <fmt/format.h>

#include <map>

#include "people/sign_in_page.hpp"

namespace rave::gui_server {
namespace {

using Fields = std::map<std::string, std::string>;

// Of one name from one network ten tries at once, then one in half a minute: a person who mistypes
// does not notice it, and others at that address are not kept out. Of one name, from wherever,
// more: else a stranger could lock the owner out. How fast many names can be tried is up to
// SlowWork.
constexpr double kTries = 10;
constexpr double kTriesPerSecond = 1.0 / 30;
constexpr double kTriesOfName = 50;
constexpr double kTriesOfNamePerSecond = 1.0 / 20;
constexpr const char* kUsedLink = "This link was already used, or is not from this server.";

std::string field(const Fields& fields, const char* name) {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string() : found->second;
}

web::Response redirect(const std::string& where) {
  web::Response response;
  response.status = 303;
  response.headers.emplace_back("Location", where);
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

/// Of a link that was pasted as a name: its path and query, if it is one of ours.
std::optional<std::string> pasted_link(const std::string& name) {
  for (const std::string_view path : {"/join?invite=", "/enter?key="}) {
    const std::size_t at = name.find(path);
    if (at == std::string::npos) continue;
    const std::string link = name.substr(at);
    // Only the letters of a secret: a redirect to anything else would be an open door to other
    // sites.
    const bool plain = link.find_first_not_of("0123456789abcdef", path.size()) == std::string::npos;
    if (plain) return link;
  }
  return std::nullopt;
}

std::string sentence(std::string text) {
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z') {
    text[0] = static_cast<char>(text[0] - 'a' + 'A');
  }
  return text + ".";
}

}  // namespace

Door::Door(Options options)
    : options_(std::move(options)),
      by_place_(kTriesPerSecond, kTries),
      by_name_(kTriesOfNamePerSecond, kTriesOfName) {}

void Door::set_port(std::uint16_t port) {
  // The prefix binds it to this host and to TLS.
  cookie_ = fmt::format("{}rave_{}", options_.tls ? "__Host-" : "", port);
}

std::string Door::new_session() { return entrance_.enter(entrance_.new_key()).value_or(""); }

std::string Door::session_of(const web::Request& request) const { return request.cookie(cookie_); }

std::optional<Person> Door::whose(std::string_view session) const {
  if (entrance_.knows(session)) return Person{"you", Role::kSuperUser, {}, true};
  return options_.accounts ? options_.accounts->who(session) : std::nullopt;
}

std::optional<Person> Door::who(const web::Request& request) const {
  return whose(session_of(request));
}

Status Door::refresh() { return options_.accounts ? options_.accounts->refresh() : Status(); }

std::optional<web::Response> Door::serve(const web::Request& request) {
  const bool reads = request.method != "POST";
  if (request.path == "/enter") return enter(request);
  if (request.path == "/login.css") return sign_in_style();
  if (request.path == "/logout") {
    // A link must not sign anybody out: pictures of other pages follow links.
    return reads ? web::text_response(405, "only POST signs out\n") : leave(request);
  }
  if (!options_.accounts) return std::nullopt;
  if (request.path == "/login" && reads) return sign_in_page(200, "", "");
  if (request.path == "/join" && reads) {
    const std::string secret = field(request.query, "invite");
    // It may have been made this very moment, by the command line.
    if (!options_.accounts->invitation(secret)) static_cast<void>(refresh());
    const auto invitation = options_.accounts->invitation(secret);
    if (invitation)
      return join_page(200, {"", invitation->name, secret, !invitation->name.empty()});
    options_.audit->note("refused", {{"why", "invitation"}, {"from", request.peer}});
    return told_page(403, kUsedLink, true);
  }
  const bool page = request.path == "/" || request.path == "/index.html";
  if (page && reads && !who(request)) {
    // Of whom the link of another site, or of a file, has brought here, the browser withholds the
    // cookie. It sends it with what this page asks for.
    if (request.header("sec-fetch-site") == "cross-site") return onward_page();
    return redirect("/login");
  }
  return std::nullopt;
}

web::Response Door::enter(const web::Request& request) {
  const auto secret = entrance_.enter(field(request.query, "key"));
  // Who is in already and follows the link again, as by "back", stays in.
  if (!secret && !who(request)) {
    options_.audit->note("refused", {{"why", "link"}, {"from", request.peer}});
    return told_page(403, kUsedLink, options_.accounts != nullptr);
  }
  if (!secret) return redirect("/");
  options_.audit->note("login", {{"user", "you"}, {"by", "link"}, {"from", request.peer}});
  return welcome(*secret);
}

web::Response Door::welcome(const std::string& session) const {
  web::Response response = redirect("/");
  response.headers.emplace_back(
      // HttpOnly: scripts, also those of components, cannot read the session. SameSite=Strict:
      // requests that other sites cause come without it.
      "Set-Cookie", fmt::format("{}={}; Path=/; HttpOnly; SameSite=Strict; Max-Age={}{}", cookie_,
                                session, Accounts::kSessionLife_s, options_.tls ? "; Secure" : ""));
  return response;
}

web::Response Door::leave(const web::Request& request) {
  const std::string session = session_of(request);
  const auto person = whose(session);
  entrance_.leave(session);
  // Writing takes a moment; a person who leaves need not wait for it.
  if (options_.accounts && person) {
    const bool posted = work_.post([accounts = options_.accounts, session] {
      static_cast<void>(accounts->sign_out(session));
    });
    if (!posted) return web::text_response(503, "busy; try again in a moment\n");
  }
  if (person) options_.audit->note("logout", {{"user", person->name}, {"from", request.peer}});
  web::Response response = redirect(options_.accounts ? "/login" : "/");
  response.headers.emplace_back(
      "Set-Cookie", fmt::format("{}=; Path=/; HttpOnly; SameSite=Strict; Max-Age=0{}", cookie_,
                                options_.tls ? "; Secure" : ""));
  return response;
}

web::Response Door::slow_down(const web::Request& request) {
  options_.audit->note("refused", {{"why", "too many tries"}, {"from", request.peer}});
  web::Response response =
      sign_in_page(429, "Too many tries. Wait half a minute, then try once more.", "");
  response.headers.emplace_back("Retry-After", "30");
  return response;
}

bool Door::serve_later(const web::Request& request, const web::Reply& reply) {
  if (!options_.accounts || request.method != "POST") return false;
  if (request.path != "/login" && request.path != "/join") return false;
  Fields fields;
  if (!web::parse_form(request.body, fields)) {
    reply(web::text_response(400, "malformed form\n"));
  } else if (request.path == "/login") {
    sign_in(request, fields, reply);
  } else {
    join(request, fields, reply);
  }
  return true;
}

bool Door::is_door(const web::Request& request) {
  return request.path == "/enter" || request.path == "/login" || request.path == "/join" ||
         request.path == "/login.css";
}

void Door::work(const web::Request& request, std::function<web::Response()> what,
                const web::Reply& reply) {
  const bool posted =
      work_.post([what = std::move(what), reply] { reply(what()); }, web::network_of(request.peer));
  if (!posted) reply(sign_in_page(503, "Too many people are signing in. Try again.", ""));
}

void Door::sign_in(const web::Request& request, const Fields& fields, const web::Reply& reply) {
  const std::string name = field(fields, "name");
  if (const auto link = pasted_link(name)) {
    reply(redirect(*link));
    return;
  }
  const auto now = web::RateLimit::Clock::now();
  // Names have no blank. In this order: who has used up their own tries uses up no others.
  if (!by_place_.take(web::network_of(request.peer) + " " + name, now) ||
      !by_name_.take(name, now)) {
    reply(slow_down(request));
    return;
  }
  work(
      request,
      [this, name, password = field(fields, "password"), peer = request.peer] {
        // On a thread of its own, because Argon2id is slow on purpose.
        const auto session = options_.accounts->sign_in(name, password);
        if (session) {
          options_.audit->note("login", {{"user", name}, {"by", "password"}, {"from", peer}});
          return welcome(*session);
        }
        // What was typed as a name may be a password: it is written down if it is a name.
        const bool known = options_.accounts->has(name);
        options_.audit->note("refused", {{"why", "password"},
                                         {"user", known ? std::string_view(name) : "unknown"},
                                         {"from", peer}});
        return sign_in_page(403, sentence(session.error().message), name);
      },
      reply);
}

void Door::join(const web::Request& request, const Fields& fields, const web::Reply& reply) {
  work(
      request,
      [this, fields, kept = kept_names_, peer = request.peer] {
        const std::string name = field(fields, "name");
        const std::string secret = field(fields, "invite");
        const auto session = options_.accounts->join(secret, name, field(fields, "password"), kept);
        if (session) {
          options_.audit->note("login", {{"user", name}, {"by", "invitation"}, {"from", peer}});
          return welcome(*session);
        }
        options_.audit->note("refused", {{"why", "invitation"}, {"from", peer}});
        const std::string note = sentence(session.error().message);
        const auto invitation = options_.accounts->invitation(secret);
        if (!invitation) return told_page(403, note, true);
        const bool fixed = !invitation->name.empty();
        return join_page(400, {note, fixed ? invitation->name : name, secret, fixed});
      },
      reply);
}

}  // namespace rave::gui_server
