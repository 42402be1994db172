// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

// What the GUI Server signs, so that hosts believe it: tickets of pages, and withdrawals of them.
// Both are text: two parts of base64url, JSON and an Ed25519 signature, with a dot between. Values
// and pure functions; any thread. Moments are seconds or milliseconds since 1970, and are given.
namespace rave::direct_line {

/// How long a ticket is good for. A page asks for the next one at half of it.
inline constexpr std::int64_t kTicketLife_s = 3600;
/// So far may the clocks of server and host be apart.
inline constexpr std::int64_t kClockSlack_s = 30;
/// Longest text of a ticket: room for some 5000 robots by name.
inline constexpr std::size_t kLongestTicket = std::size_t{240} << 10U;

using PublicKey = std::array<unsigned char, 32>;

/// Both halves of the key of a GUI Server. The secret half never leaves its process but by
/// write_key_files().
struct SigningKey {
  PublicKey open{};
  std::array<unsigned char, 64> secret{};
};
[[nodiscard]] SigningKey new_signing_key();

/// Some robots of a host, or all of them.
struct RobotSet {
  bool all = false;
  std::set<std::string, std::less<>> names;  ///< Empty if `all`.

  [[nodiscard]] bool has(std::string_view robot) const { return all || names.contains(robot); }
  [[nodiscard]] bool empty() const { return !all && names.empty(); }
  friend bool operator==(const RobotSet&, const RobotSet&) = default;
};

/// What one person may do at one host, for a page that has a key.
struct Ticket {
  std::string run;   ///< As its processes call it.
  std::string host;  ///< Its name in the scenario.
  std::string user;
  std::string role;    ///< `commander` or `super_user`.
  std::string origin;  ///< Of the page, such as `https://lab.example:8080`.
  RobotSet orders;     ///< That may be ordered about.
  RobotSet stops;
  RobotSet releases;
  std::string page_key;     ///< 65 bytes: a point of P-256, not compressed.
  std::uint64_t epoch = 0;  ///< Below that of a withdrawal for this person: not good any more.
  std::int64_t expires_s = 0;
  std::string nonce;  ///< Random; of two lines with the same ticket the newer one stays.

  friend bool operator==(const Ticket&, const Ticket&) = default;
};

/// The number by which leases know a page: of its key, or of another secret that it alone has.
/// Never 0.
[[nodiscard]] std::uint64_t page_number(std::string_view key);

[[nodiscard]] std::string sign_ticket(const Ticket& ticket, const SigningKey& key);

/// Errors: kParse (it is none, or too long), kState (another key has signed it, or it has expired,
/// or lasts longer than a ticket may).
[[nodiscard]] Result<Ticket> verify_ticket(std::string_view text, const PublicKey& key,
                                           std::int64_t now_s);

/// Tickets of a person with a lower epoch are not good any more.
struct Withdrawal {
  std::string run;
  std::string user;
  std::uint64_t epoch = 0;
  friend bool operator==(const Withdrawal&, const Withdrawal&) = default;
};
[[nodiscard]] std::string sign_withdrawal(const Withdrawal& withdrawal, const SigningKey& key);
/// Errors: kParse, kState.
[[nodiscard]] Result<Withdrawal> verify_withdrawal(std::string_view text, const PublicKey& key);

}  // namespace rave::direct_line
