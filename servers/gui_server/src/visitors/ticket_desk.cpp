// SPDX-License-Identifier: Apache-2.0
#include "visitors/ticket_desk.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "people/secrets.hpp"
#include "rave/base/json_text.hpp"
#include "rave/base/wall_clock.hpp"
#include "visitors/ticket_request.hpp"

namespace rave::gui_server {
namespace {

using TicketJson = nlohmann::ordered_json;
using direct_line::HostLine;
using direct_line::RobotSet;

std::int64_t day_ms() { return wall_ns() / 1'000'000; }

web::Response json_response(int status, const TicketJson& json) {
  web::Response response = web::text_response(status, json_text(json) + "\n");
  response.type = "application/json";
  // A ticket is a secret: no cache on the way may keep it.
  response.headers.emplace_back("Cache-Control", "no-store");
  return response;
}

web::Response refused(int status, std::string_view why) {
  return json_response(status, {{"why", why}});
}

using Indices = std::map<std::string_view, std::uint32_t>;

Indices indices_of(const Cast& cast) {
  Indices indices;
  for (std::uint32_t r = 0; r < cast.names.size(); ++r) indices.emplace(cast.names[r], r);
  return indices;
}

/// Those of a host for which a class is given.
RobotSet robots_with(InfoClass what, const HostLine& line, const View& view,
                     const Indices& indices) {
  RobotSet robots;
  for (const std::string& robot : line.robots) {
    const auto index = indices.find(robot);
    if (index != indices.end() && view.may(what, index->second)) robots.names.insert(robot);
  }
  // "All" keeps a ticket small for hosts with thousands of robots. An empty host has no robots to
  // name, and must not give a ticket for all.
  robots.all = robots.names.size() == line.robots.size() && !line.robots.empty();
  if (robots.all) robots.names.clear();
  return robots;
}

/// The robots of a host that its line is for; withheld ones are not named.
TicketJson names_of(const HostLine& line, const RobotSet& orders, const RobotSet& stops) {
  TicketJson names = TicketJson::array();
  for (const std::string& robot : line.robots) {
    if (orders.has(robot) || stops.has(robot)) names.push_back(robot);
  }
  return names;
}

}  // namespace

TicketDesk::TicketDesk(std::shared_ptr<AuditLog> audit)
    : audit_(std::move(audit)), first_epoch_(static_cast<std::uint64_t>(day_ms())) {}

void TicketDesk::offer(std::shared_ptr<direct_line::Lines> lines,
                       const direct_line::SigningKey& key) {
  lines_ = std::move(lines);
  key_ = key;
}

std::string TicketDesk::rights_of(const Person& person, const View& view) {
  return std::string(to_string(person.role)) + " " + person.teams.text() + " " + view.key();
}

std::uint64_t TicketDesk::epoch_of(const std::string& user) const {
  const auto raised = epochs_.find(user);
  return raised == epochs_.end() ? first_epoch_ : raised->second;
}

web::Response TicketDesk::serve(const web::Request& request, const Asker& asker) {
  auto page_key = parse_ticket_request(request.body);
  if (!page_key) return refused(400, page_key.error().message);
  const std::string origin(request.header("origin"));
  // The origin becomes a part of the ticket, so that a page of another site cannot use it.
  if (origin.empty()) return refused(400, "the request has no Origin header");
  if (asker.person.role == Role::kObserver) {
    audit_->note("refused",
                 {{"why", "ticket"}, {"user", asker.person.name}, {"from", request.peer}});
    return refused(403, "Observers cannot give orders.");
  }
  TicketJson answer = {{"relay", asker.relay}, {"lines", TicketJson::array()}};
  if (!lines_) return json_response(200, answer);
  direct_line::Ticket ticket;
  ticket.run = lines_->run();
  ticket.user = asker.person.name;
  ticket.role = to_string(asker.person.role);
  ticket.origin = origin;
  ticket.page_key = *std::move(page_key);
  ticket.epoch = epoch_of(ticket.user);
  ticket.expires_s = day_ms() / 1000 + direct_line::kTicketLife_s;
  // One for all hosts: the same page.
  ticket.nonce = new_secret();
  const Indices indices = indices_of(asker.view->cast());
  for (const HostLine& line : lines_->hosts()) {
    ticket.host = line.host;
    ticket.orders = robots_with(InfoClass::kCommand, line, *asker.view, indices);
    ticket.stops = robots_with(InfoClass::kStop, line, *asker.view, indices);
    ticket.releases = robots_with(InfoClass::kRelease, line, *asker.view, indices);
    if (ticket.orders.empty() && ticket.stops.empty()) continue;
    answer["lines"].push_back({{"host", line.host},
                               {"url", line.url},
                               {"ticket", direct_line::sign_ticket(ticket, key_)},
                               {"expires", ticket.expires_s},
                               {"robots", names_of(line, ticket.orders, ticket.stops)}});
  }
  note(asker, ticket, request.peer);
  return json_response(200, answer);
}

void TicketDesk::note(const Asker& asker, const direct_line::Ticket& ticket,
                      const std::string& peer) {
  std::string rights = rights_of(asker.person, *asker.view);
  Given& given = given_[asker.session];
  // A page asks again and again; the first time counts.
  if (given.rights != rights) audit_->note("ticket", {{"user", ticket.user}, {"from", peer}});
  given = {ticket.user, std::move(rights), ticket.expires_s};
}

void TicketDesk::check(const Rights& rights) {
  const std::int64_t now_s = day_ms() / 1000;
  std::vector<std::string> others;
  std::erase_if(given_, [&](const auto& entry) {
    const auto& [session, given] = entry;
    if (given.until_s + direct_line::kClockSlack_s < now_s) return true;
    if (rights(session) == given.rights) return false;
    others.push_back(given.user);
    return true;
  });
  for (const std::string& user : others) raise(user);
}

void TicketDesk::raise(const std::string& user) {
  if (!lines_) return;
  // From the clock, so that it also rises over a restart of the server, which forgets the epochs.
  // The maximum keeps it rising if the clock was set back.
  const std::uint64_t epoch = std::max(epoch_of(user) + 1, static_cast<std::uint64_t>(day_ms()));
  epochs_[user] = epoch;
  lines_->withdraw(user, direct_line::sign_withdrawal({lines_->run(), user, epoch}, key_));
  audit_->note("withdrawn", {{"user", user}});
}

std::vector<std::string> TicketDesk::ends() const {
  std::vector<std::string> ends = expected_;
  if (!lines_) return ends;
  for (const HostLine& line : lines_->hosts()) {
    const std::size_t host = line.url.find("://");
    ends.push_back(line.url.substr(0, line.url.find('/', host + 3)));
  }
  return ends;
}

void TicketDesk::expect_lines_at(std::string_view origin) {
  // `http://HOST:PORT` becomes `ws://HOST:*`, and `https` `wss`.
  const std::string host(origin.substr(4, origin.rfind(':') - 4));
  expected_ = {"ws" + host + ":*"};
}

}  // namespace rave::gui_server
