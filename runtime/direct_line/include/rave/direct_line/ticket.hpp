// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

// Texts signed by the GUI Server for hosts: tickets of pages, and withdrawals of tickets. Each is
// JSON and an Ed25519 signature, both in base64url, separated by a dot. Values and pure functions;
// any thread. Times are in seconds or milliseconds since 1970 and are passed by the caller.
namespace rave::direct_line {

/// Validity of a ticket. A page requests the next one after half of it.
inline constexpr std::int64_t kTicketLife_s = 3600;
/// Largest accepted difference between the clocks of server and host.
inline constexpr std::int64_t kClockSlack_s = 30;
/// Longest text of a ticket in bytes; enough for about 5000 robots by name.
inline constexpr std::size_t kLongestTicket = std::size_t{240} << 10U;

using PublicKey = std::array<unsigned char, 32>;

/// The key pair of a GUI Server. The secret half leaves the process only by write_key_files().
struct SigningKey {
  PublicKey open{};
  std::array<unsigned char, 64> secret{};
};
[[nodiscard]] SigningKey new_signing_key();

/// A set of robots of a host.
struct RobotSet {
  bool all = false;
  std::set<std::string, std::less<>> names;  ///< Empty if `all`.

  [[nodiscard]] bool has(std::string_view robot) const { return all || names.contains(robot); }
  [[nodiscard]] bool empty() const { return !all && names.empty(); }
  friend bool operator==(const RobotSet&, const RobotSet&) = default;
};

/// The rights of one user at one host, for a page with a certain key.
struct Ticket {
  std::string run;   ///< The run, by the name that its processes use.
  std::string host;  ///< Name of the host in the scenario.
  std::string user;
  std::string role;    ///< `commander` or `super_user`.
  std::string origin;  ///< Origin of the page, such as `https://lab.example:8080`.
  RobotSet orders;     ///< Robots that the user may give orders.
  RobotSet stops;
  RobotSet releases;
  std::string page_key;  ///< 65 bytes: an uncompressed point of P-256.
  /// The ticket is invalid if this is below the epoch of a withdrawal for the user.
  std::uint64_t epoch = 0;
  std::int64_t expires_s = 0;
  std::string nonce;  ///< Random; of two lines with the same ticket only the newer stays open.

  friend bool operator==(const Ticket&, const Ticket&) = default;
};

/// A page key in base64url, as its 65 bytes. Error: kParse.
[[nodiscard]] Result<std::string> page_key_of(std::string_view text);

/// The id of a page for leases: a hash of its key, or of another secret that only the page has.
/// Never 0.
[[nodiscard]] std::uint64_t page_number(std::string_view key);

[[nodiscard]] std::string sign_ticket(const Ticket& ticket, const SigningKey& key);

/// Checks and decodes a ticket. Errors: kParse (not a ticket, or too long), kState (signed by
/// another key, expired, or valid for too long).
[[nodiscard]] Result<Ticket> verify_ticket(std::string_view text, const PublicKey& key,
                                           std::int64_t now_s);

/// Declares all tickets of a user with a lower epoch invalid.
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
