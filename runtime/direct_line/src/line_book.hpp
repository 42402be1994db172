// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "line.hpp"
#include "line_message.hpp"
#include "order_post.hpp"
#include "rave/base/log.hpp"
#include "rave/direct_line/line_server.hpp"
#include "rave/web/rate_limit.hpp"

namespace rave::direct_line {

/// The lines of a host: who is connected, with which rights. Used by the thread of the server.
class LineBook {
 public:
  /// The reason for closing a line.
  enum Code : std::uint16_t {
    kNonsense = 4400,
    kBadTicket = 4401,  ///< No ticket, or an expired one.
    kWithdrawn = 4403,  ///< The rights have changed: the page requests a new ticket.
    kReplaced = 4408,   ///< The same page has opened another line.
    kTooManyLines = 4429,
  };

  /// Lines with a ticket, and how many of these are for super-users alone.
  static constexpr std::size_t kMostLines = 256;
  static constexpr std::size_t kReserve = 32;

  LineBook(const LineOptions& options, runtime::RunControl& control);

  void opened(std::uint64_t id, web::Socket& socket, const web::Request& request);
  void received(std::uint64_t id, std::string_view text);
  /// The page sends too much, and its line is being closed for it.
  void flooded(std::uint64_t id);
  void closed(std::uint64_t id);
  void withdraw(const std::string& signed_text);
  /// Passes on the answers that have arrived; called about 200 times a second.
  void poll() { post_.poll(); }
  /// Ends expired lines, and tells the pages who drives and who is stopped; called a few times a
  /// second.
  void look_around();
  /// Stops all robots that are driven.
  void end();

 private:
  using Request = request::Request;

  void take(std::uint64_t id, Line& line, const HelloMessage& hello);
  void take(std::uint64_t id, Line& line, const RenewMessage& renew);
  void take(std::uint64_t id, Line& line, const PingMessage& ping);
  void take(std::uint64_t id, Line& line, const OrderMessage& order);
  [[nodiscard]] Result<Ticket> check_ticket(std::string_view text, const Line& line) const;
  /// The same order for each robot that the ticket covers. Error kState if it covers none.
  [[nodiscard]] static Result<std::vector<Request>> covered(const Ticket& ticket,
                                                            const Request& request);
  /// Whether the person to whom a lease is given has a line here. Error kNotFound: who else has.
  [[nodiscard]] Status may_give(const Ticket& giver, const Request& give) const;
  void make_room_for_stranger();
  /// Whether another line may have this ticket.
  [[nodiscard]] bool has_room(const Ticket& ticket) const;
  void welcome(std::uint64_t id, Line& line, Ticket ticket);
  void close(Line& line, std::uint16_t code, std::string_view why);
  void refuse_line(Line& line, std::string_view why);
  /// Why a line is cut off. Apart from refusals, so that these do not use up its place in the log.
  void note_cut(const Line& line, std::string_view why);
  void note_refusal(const Line& line, std::string_view what, std::string_view why);
  void answer(std::uint64_t id, std::uint64_t order, bool good, const std::string& text);
  void leave_leases(const Line& line);
  void tell_state();
  [[nodiscard]] std::int64_t now_ms() const { return options_.clock_ms(); }

  LineOptions options_;
  runtime::RunControl& control_;
  OrderPost post_;
  std::map<std::uint64_t, Line> lines_;
  std::map<std::string, std::uint64_t, std::less<>> epochs_;  ///< By person.
  web::RateLimit refusals_;
  web::RateLimit cuts_;
  std::uint64_t untold_ = 0;  ///< Refusals omitted from the log because there were too many.
};

}  // namespace rave::direct_line
