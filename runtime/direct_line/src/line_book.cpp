// SPDX-License-Identifier: Apache-2.0
#include "line_book.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <vector>

#include "page_key.hpp"
#include "rave/base/json_text.hpp"
#include "rave/base/names.hpp"
#include "rave/base/wall_clock.hpp"
#include "signed_text.hpp"

namespace rave::direct_line {
namespace {

using LineJson = nlohmann::ordered_json;

/// A page that has not shown a ticket within this time is disconnected.
constexpr auto kHelloPatience = std::chrono::seconds(5);
constexpr std::size_t kMostStrangers = 64;
constexpr std::size_t kMostOfUser = 32;
constexpr unsigned kMostNonsense = 20;
constexpr std::size_t kChallengeBytes = 32;
constexpr std::size_t kMostRemembered = 2000;
// Thirty refusals at once per network, then one in five seconds: a flood must not fill the disk.
constexpr double kRefusals = 30;
constexpr double kRefusalsPerSecond = 0.2;

std::string dumped(const LineJson& json) { return json_text(json); }

/// The robots for which a ticket permits a kind of order.
const RobotSet& reach_of(const Ticket& ticket, const request::Request& request) {
  if (request.is<request::Stop>()) return ticket.stops;
  if (request.is<request::Release>()) return ticket.releases;
  return ticket.orders;
}

}  // namespace

LineBook::LineBook(const LineOptions& options, runtime::RunControl& control)
    : options_(options),
      control_(control),
      post_(control),
      refusals_(kRefusalsPerSecond, kRefusals),
      cuts_(kRefusalsPerSecond, kRefusals) {
  if (!options_.clock_ms) options_.clock_ms = [] { return wall_ns() / 1'000'000; };
}

void LineBook::opened(std::uint64_t id, web::Socket& socket, const web::Request& request) {
  Line line;
  line.socket = &socket;
  line.peer = request.peer;
  // The address that the page dialled is part of its proof, so another host cannot pass the
  // challenge on.
  line.address = request.header("host");
  line.origin = request.header("origin");
  line.challenge = base64_of(random_bytes(kChallengeBytes));
  line.since = Line::Clock::now();
  make_room_for_stranger();
  Line& kept = lines_.emplace(id, std::move(line)).first->second;
  kept.send(
      dumped({{"type", "challenge"}, {"host", options_.host}, {"challenge", kept.challenge}}));
}

/// Only lines without a ticket count, so that strangers cannot take the room of pages. A newcomer
/// always gets a place, for it may be a page that is about to stop a robot: of the network with the
/// most the oldest goes.
void LineBook::make_room_for_stranger() {
  std::map<std::string, std::vector<Line*>> strangers;
  std::size_t count = 0;
  for (auto& [id, line] : lines_) {
    if (line.ticket || line.closing) continue;
    strangers[web::network_of(line.peer)].push_back(&line);
    ++count;
  }
  if (count < kMostStrangers) return;
  const auto most = std::ranges::max_element(
      strangers, {}, [](const auto& of_network) { return of_network.second.size(); });
  // Numbers of lines count up, so the first is the oldest.
  Line& oldest = *most->second.front();
  note_refusal(oldest, "a line", "too many connections without a ticket");
  close(oldest, kTooManyLines, "too many connections");
}

void LineBook::received(std::uint64_t id, std::string_view text) {
  const auto found = lines_.find(id);
  if (found == lines_.end() || found->second.closing) return;
  Line& line = found->second;
  const auto message = parse_line_message(text);
  if (!message) {
    note_refusal(line, "a message", message.error().message);
    line.send(dumped({{"type", "answer"}, {"good", false}, {"text", message.error().message}}));
    // A page with a ticket may be of another version and is given some patience; a stranger is not.
    if (!line.ticket || ++line.nonsense > kMostNonsense) {
      note_cut(line, "malformed messages");
      close(line, kNonsense, "malformed messages");
    }
    return;
  }
  if (!line.ticket && !std::holds_alternative<HelloMessage>(*message)) {
    return refuse_line(line, "expected a ticket first");
  }
  std::visit([&](const auto& what) { take(id, line, what); }, *message);
}

void LineBook::flooded(std::uint64_t id) {
  const auto found = lines_.find(id);
  if (found == lines_.end() || found->second.closing) return;
  found->second.closing = true;
  note_cut(found->second, "too many messages");
}

void LineBook::closed(std::uint64_t id) {
  const auto found = lines_.find(id);
  if (found == lines_.end()) return;
  // The end of the line ends driving, for whatever reason it ended.
  post_.forget(id);
  if (found->second.ticket) leave_leases(found->second);
  if (found->second.ticket && options_.log != nullptr) {
    options_.log->info("line", "{} has disconnected", found->second.who());
  }
  lines_.erase(found);
}

/// Gives up the leases of a page, so that the page can take the robots again after a reload or a
/// new connection. The status reports leases one step late, so robots that the line has ordered
/// count as well.
void LineBook::leave_leases(const Line& line) {
  const std::uint64_t page = page_number(line.ticket->page_key);
  for (const runtime::RunStatus::Robot& robot : control_.status().robots) {
    const bool has = robot.lease == line.ticket->user && robot.lease_page == page;
    if (!has && !line.ordered.contains(robot.name)) continue;
    Request leave;
    leave.action = request::Give{line.ticket->user};
    leave.robot = robot.name;
    leave.by = line.ticket->user;
    leave.page = page;
    // The page is gone, so the answer is not needed.
    static_cast<void>(control_.post(std::move(leave)));
  }
}

void LineBook::end() {
  for (const auto& [id, line] : lines_) post_.forget(id);
  lines_.clear();
}

Result<Ticket> LineBook::check_ticket(std::string_view text, const Line& line) const {
  RAVE_TRY_ASSIGN(Ticket ticket, verify_ticket(text, options_.signer, now_ms() / 1000));
  if (ticket.run != options_.run) return fail(ErrorCode::kState, "the ticket is for another run");
  if (ticket.host != options_.host) {
    return fail(ErrorCode::kState, "the ticket is for host `{}`, and this is `{}`", ticket.host,
                options_.host);
  }
  if (ticket.origin != line.origin) {
    return fail(ErrorCode::kState, "the ticket is for a page from {}, but this page is from {}",
                ticket.origin, line.origin.empty() ? "nowhere" : line.origin);
  }
  const auto epoch = epochs_.find(ticket.user);
  if (epoch != epochs_.end() && ticket.epoch < epoch->second) {
    return fail(ErrorCode::kState, "the ticket of `{}` was withdrawn", ticket.user);
  }
  return ticket;
}

void LineBook::take(std::uint64_t id, Line& line, const HelloMessage& hello) {
  if (line.ticket) return refuse_line(line, "sent hello twice");
  auto ticket = check_ticket(hello.ticket, line);
  if (!ticket) return refuse_line(line, ticket.error().message);
  const std::string text = proof_text(line.challenge, line.address, hello.ticket);
  if (!page_key_signed(ticket->page_key, hello.proof, text)) {
    return refuse_line(line, "showed a ticket of `" + ticket->user +
                                 "` without the key of the page that it was given to");
  }
  welcome(id, line, *std::move(ticket));
}

bool LineBook::has_room(const Ticket& ticket) const {
  std::size_t all = 0;
  std::size_t of_user = 0;
  for (const auto& [id, line] : lines_) {
    // The page's own earlier line is about to be replaced.
    if (!line.ticket || line.closing || line.ticket->nonce == ticket.nonce) continue;
    ++all;
    if (line.ticket->user == ticket.user) ++of_user;
  }
  if (ticket.role == "super_user") return all < kMostLines;
  return of_user < kMostOfUser && all < kMostLines - kReserve;
}

void LineBook::welcome(std::uint64_t id, Line& line, Ticket ticket) {
  if (!has_room(ticket)) {
    note_refusal(line, "a line", "too many connections of `" + ticket.user + "`");
    return close(line, kTooManyLines, "too many connections");
  }
  for (auto& [other_id, other] : lines_) {
    // A page that connects anew before this host has noticed the end of its old line replaces it.
    if (other_id == id || !other.ticket || other.ticket->nonce != ticket.nonce) continue;
    post_.forget(other_id);
    close(other, kReplaced, "the page opened another line");
  }
  line.ticket = std::move(ticket);
  if (options_.log != nullptr) {
    options_.log->info("line", "{} has connected as {}", line.who(), line.ticket->role);
  }
  line.send(dumped({{"type", "welcome"},
                    {"host", options_.host},
                    {"user", line.ticket->user},
                    {"until", line.ticket->expires_s}}));
}

void LineBook::take(std::uint64_t /*id*/, Line& line, const RenewMessage& renew) {
  auto ticket = check_ticket(renew.ticket, line);
  if (!ticket) return refuse_line(line, ticket.error().message);
  // The challenge was answered for this page and this person only.
  if (ticket->page_key != line.ticket->page_key || ticket->user != line.ticket->user) {
    return refuse_line(line, "the ticket belongs to another page or person");
  }
  line.ticket = *std::move(ticket);
  line.send(dumped({{"type", "renewed"}, {"until", line.ticket->expires_s}}));
}

void LineBook::take(std::uint64_t /*id*/, Line& line, const PingMessage& ping) {
  line.send(dumped({{"type", "pong"}, {"id", ping.id}}));
}

Result<std::vector<request::Request>> LineBook::covered(const Ticket& ticket,
                                                        const Request& request) {
  const RobotSet& reach = reach_of(ticket, request);
  const std::string_view word = request::name_of(request.action);
  if (!request.robot.empty() && !reach.has(request.robot)) {
    return fail(ErrorCode::kState, "your rights do not include `{}` of `{}`", word, request.robot);
  }
  if (request.is<request::Place>() && ticket.role != "super_user") {
    return fail(ErrorCode::kState, "only a super-user can place a robot");
  }
  if (reach.empty()) return fail(ErrorCode::kState, "your rights do not include `{}`", word);
  Request signed_one = request;
  signed_one.by = ticket.user;
  signed_one.overrides = ticket.role == "super_user";
  signed_one.page = page_number(ticket.page_key);
  std::vector<Request> requests;
  if (!request.robot.empty() || reach.all) {
    requests.push_back(std::move(signed_one));
    return requests;
  }
  for (const std::string& robot : reach.names) {
    signed_one.robot = robot;
    requests.push_back(signed_one);
  }
  return requests;
}

Status LineBook::may_give(const Ticket& giver, const Request& give) const {
  const auto* const gift = give.as<request::Give>();
  if (gift == nullptr || gift->to.empty() || gift->to == giver.user) return {};
  const std::string& to = gift->to;
  std::set<std::string_view> able;
  for (const auto& [id, line] : lines_) {
    if (line.closing || !line.ticket || !line.ticket->orders.has(give.robot)) continue;
    if (line.ticket->user == to) return {};
    if (line.ticket->user != giver.user) able.insert(line.ticket->user);
  }
  return fail(ErrorCode::kNotFound, "`{}` is not here, or may not command {}; {}", to, give.robot,
              able.empty()
                  ? std::string("no other person who may is here")
                  : "it can be given to " +
                        join_names(std::vector<std::string_view>(able.begin(), able.end()), "or"));
}

void LineBook::take(std::uint64_t id, Line& line, const OrderMessage& order) {
  auto requests = covered(*line.ticket, order.request);
  if (const Status may = may_give(*line.ticket, order.request); requests && !may) {
    requests = tl::unexpected(may.error());
  }
  if (!requests) {
    note_refusal(line, request::name_of(order.request.action), requests.error().message);
    return answer(id, order.id, false, requests.error().message);
  }
  const bool takes_lease =
      request::is_order(order.request.action) || order.request.is<request::Take>();
  // Only an attacker who wants to fill the memory names more robots than a page commands at once.
  if (takes_lease && line.ordered.size() < kMostRemembered) {
    line.ordered.insert(order.request.robot);
  }
  auto told = [this, id, order_id = order.id](bool good, const std::string& text) {
    answer(id, order_id, good, text);
  };
  if (order.request.is<request::Drive>()) {
    return post_.drive(id, std::move(requests->front()), order.echo, std::move(told));
  }
  post_.give(id, *std::move(requests), std::move(told));
}

void LineBook::answer(std::uint64_t id, std::uint64_t order, bool good, const std::string& text) {
  const auto found = lines_.find(id);
  if (found == lines_.end() || found->second.closing) return;
  found->second.send(dumped({{"type", "answer"}, {"id", order}, {"good", good}, {"text", text}}));
}

void LineBook::close(Line& line, std::uint16_t code, std::string_view why) {
  line.closing = true;
  line.socket->close(code, why);
}

void LineBook::refuse_line(Line& line, std::string_view why) {
  note_refusal(line, "a line", why);
  close(line, kBadTicket, why);
}

void LineBook::note_cut(const Line& line, std::string_view why) {
  if (options_.log == nullptr) return;
  if (!cuts_.take(web::network_of(line.peer), web::RateLimit::Clock::now())) return;
  options_.log->warn("line", "cut off {}: {}", line.who(), why);
}

void LineBook::note_refusal(const Line& line, std::string_view what, std::string_view why) {
  if (options_.log == nullptr) return;
  if (!refusals_.take(web::network_of(line.peer), web::RateLimit::Clock::now())) {
    ++untold_;
    return;
  }
  if (untold_ > 0) options_.log->warn("line", "{} more refused", std::exchange(untold_, 0));
  options_.log->warn("line", "refused {} of {}: {}", what, line.who(), why);
}

void LineBook::withdraw(const std::string& signed_text) {
  const auto withdrawal = verify_withdrawal(signed_text, options_.signer);
  if (!withdrawal) {
    if (options_.log != nullptr) {
      options_.log->warn("line", "a withdrawal was ignored: {}", withdrawal.error().message);
    }
    return;
  }
  std::uint64_t& epoch = epochs_[withdrawal->user];
  // epoch) return; <= Withdrawals are durable on the bus and may arrive again, or out of order;
  // epochs only grow.
  if (withdrawal->run != options_.run || withdrawal->epoch <= epoch) return;
  epoch = withdrawal->epoch;
  for (auto& [id, line] : lines_) {
    if (line.closing || !line.ticket || line.ticket->user != withdrawal->user) continue;
    if (line.ticket->epoch >= epoch) continue;
    if (options_.log != nullptr) options_.log->warn("line", "{}: rights changed", line.who());
    post_.forget(id);
    close(line, kWithdrawn, "your rights have changed");
  }
}

void LineBook::look_around() {
  const auto now = Line::Clock::now();
  for (auto& [id, line] : lines_) {
    if (line.closing) continue;
    if (!line.ticket && now - line.since > kHelloPatience) {
      refuse_line(line, "showed no ticket");
    } else if (line.ticket && line.ticket->expires_s + kClockSlack_s < now_ms() / 1000) {
      post_.forget(id);
      refuse_line(line, "the ticket has expired");
    }
  }
  tell_state();
}

void LineBook::tell_state() {
  const bool anybody = std::ranges::any_of(
      lines_, [](const auto& entry) { return entry.second.ticket.has_value(); });
  if (!anybody) return;
  const runtime::RunStatus status = control_.status();
  for (auto& [id, line] : lines_) {
    if (line.closing || !line.ticket) continue;
    LineJson leases = LineJson::object();
    LineJson stopped = LineJson::array();
    for (const runtime::RunStatus::Robot& robot : status.robots) {
      if (!robot.lease.empty() && line.ticket->orders.has(robot.name)) {
        leases[robot.name] = robot.lease;
      }
      if (robot.stopped && line.ticket->stops.has(robot.name)) stopped.push_back(robot.name);
    }
    std::string text =
        dumped({{"type", "state"}, {"leases", std::move(leases)}, {"stopped", std::move(stopped)}});
    // The state is asked for often and changes seldom.
    if (text == line.told_state) continue;
    line.told_state = text;
    line.send(std::move(text));
  }
}

}  // namespace rave::direct_line
