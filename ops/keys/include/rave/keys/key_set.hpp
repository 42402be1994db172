// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

// Certificates for DDS Security, as a folder:
//
//     lab-keys/ca/     authority.pem, authority_key.pem: a holder of these can add members
//     lab-keys/left/   the six files for `BusConfig::security` and `--security`
//     lab-keys/right/  the same for another process or machine
//
// All functions may be called from any thread, but not two at a time for the same folder. Times
// are seconds since 1970, UTC, and are passed by the caller; nothing here reads a clock.
namespace rave::keys {

/// Longest validity; well below the largest date that DDS can represent.
inline constexpr int kMostDays = 36'500;
/// Certificates are valid from this long before their creation, for machines whose clock is slow.
inline constexpr std::int64_t kHeadStart_s = 86'400;

struct NewKeySet {
  /// Created by the function, private to the user (0700), keys 0600. Its parent folder must exist.
  std::filesystem::path folder;
  /// The name in all certificates; with the syntax of member names.
  std::string lab = "rave";
  /// Validity in days: 1 to kMostDays.
  int days = 3650;
  /// At least one.
  std::vector<std::string> members;
  std::int64_t now_s = 0;
};

/// Checks the name of a member: 1 to 64 letters, digits, `-` and `_`, the first a letter or digit,
/// and not `ca`. Error kInvalidArgument.
[[nodiscard]] Status check_name(std::string_view name);

/// Creates a set with a new authority. Creates the whole folder or nothing. Errors:
/// kInvalidArgument (a name, the days, or the folder exists), kNotFound (no parent folder), kIo.
[[nodiscard]] Status make_key_set(const NewKeySet& set);

/// Adds members to a set with the authority in its folder `ca`; all of them or none. They are valid
/// for `days`, 0 to kMostDays, but not longer than the authority; 0: as long as it. Errors:
/// kInvalidArgument (a name, the days, or a member exists), kNotFound (no such set), kState (the
/// authority is damaged, of another kind, or expired), kIo.
[[nodiscard]] Status add_members(const std::filesystem::path& folder,
                                 const std::vector<std::string>& members, int days,
                                 std::int64_t now_s);

/// The content of the certificate of an authority or member.
struct KeyInfo {
  std::string name;
  std::int64_t from_s = 0;
  std::int64_t until_s = 0;
  std::string fingerprint;            ///< SHA-256 of the certificate, `3F:09:...`.
  std::vector<std::string> problems;  ///< Why it cannot be used, or is unsafe.

  /// Whole days until it expires; negative if it has expired.
  [[nodiscard]] std::int64_t days_left(std::int64_t now_s) const noexcept;
};

struct KeySetInfo {
  std::string lab;
  KeyInfo authority;
  std::vector<KeyInfo> members;  ///< By name.
};

/// The content of a set, or of the folder of one member. Members with problems are listed too.
/// Errors: kNotFound (no such folder, or no keys in it), kState (the authority's certificate cannot
/// be read), kIo.
[[nodiscard]] Result<KeySetInfo> read_key_set(const std::filesystem::path& folder);

/// A date such as `2036-11-19`, in UTC.
[[nodiscard]] std::string date_text(std::int64_t moment_s);

}  // namespace rave::keys
