// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

// The certificates that switch DDS Security on, as a folder:
//
//     lab-keys/ca/     authority.pem, authority_key.pem: who has these can make members
//     lab-keys/left/   the six files that `BusConfig::security` and `--security` ask for
//     lab-keys/right/  the same for another process or machine
//
// All functions may be called from any thread, not two at a time for the same folder. Moments are
// seconds since the beginning of 1970, UTC; they are given, so that nothing here asks a clock.
namespace rave::keys {

/// Longest validity: what DDS can still say of a date is far behind it.
inline constexpr int kMostDays = 36'500;
/// Certificates begin this long before they are made, for machines whose clock is late.
inline constexpr std::int64_t kHeadStart_s = 86'400;

struct NewKeySet {
  /// Is made, private to the user (0700), keys 0600. Its parent folder must exist.
  std::filesystem::path folder;
  /// Stands in all certificates; a name like those of members.
  std::string lab = "rave";
  /// How long everything is valid: 1 to kMostDays.
  int days = 3650;
  /// At least one.
  std::vector<std::string> members;
  std::int64_t now_s = 0;
};

/// Whether a member can have that name: 1 to 64 letters, digits, `-` and `_`, the first of which is
/// a letter or digit, and not `ca`. Error kInvalidArgument.
[[nodiscard]] Status check_name(std::string_view name);

/// Makes a set with a fresh authority. Either the whole folder comes into being or nothing does.
/// Errors: kInvalidArgument (a name, the days, or the folder is there already), kNotFound (no
/// parent folder), kIo.
[[nodiscard]] Status make_key_set(const NewKeySet& set);

/// Adds members to a set with the authority in its folder `ca`; all of them or none. They are valid
/// for `days`, 0 to kMostDays, but not beyond the authority; 0: as long as it.
/// Errors: kInvalidArgument (a name, the days, or a member is there already), kNotFound (no such
/// set), kState (the authority is damaged, is not for this, or has expired), kIo.
[[nodiscard]] Status add_members(const std::filesystem::path& folder,
                                 const std::vector<std::string>& members, int days,
                                 std::int64_t now_s);

/// What is in the certificate of an authority or member.
struct KeyInfo {
  std::string name;
  std::int64_t from_s = 0;
  std::int64_t until_s = 0;
  std::string fingerprint;            ///< SHA-256 of the certificate, `3F:09:...`.
  std::vector<std::string> problems;  ///< What keeps it from being used, or makes it unsafe.

  /// Whole days until it expires; negative if it has.
  [[nodiscard]] std::int64_t days_left(std::int64_t now_s) const noexcept;
};

struct KeySetInfo {
  std::string lab;
  KeyInfo authority;
  std::vector<KeyInfo> members;  ///< By name.
};

/// What a set holds, or the folder of one member. A member with a problem is listed with it.
/// Errors: kNotFound (no such folder, or no keys in it), kState (the authority's certificate cannot
/// be read), kIo.
[[nodiscard]] Result<KeySetInfo> read_key_set(const std::filesystem::path& folder);

/// `2036-11-19`, in UTC.
[[nodiscard]] std::string date_text(std::int64_t moment_s);

}  // namespace rave::keys
