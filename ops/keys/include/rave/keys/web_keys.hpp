// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

// The certificates with which the GUI Server shows itself to browsers, as a folder:
//
//     web-keys/authority.pem      what browsers are told to trust
//     web-keys/authority_key.pem  who has this can pretend to be the server, and nobody else
//     web-keys/server.pem, server_key.pem   for `rave gui --certificate ... --key ...`
//
// It has nothing to do with the authority of a key set, which signs permissions of DDS for years
// and must never get into a browser. All functions: any thread, not two at a time for the same
// folder.
namespace rave::keys {

/// Browsers refuse certificates of servers that are valid for longer.
inline constexpr int kMostWebDays = 397;

struct NewWebKeys {
  std::filesystem::path folder;
  /// What people type: names of hosts and addresses; at least one.
  std::vector<std::string> names;
  int days = kMostWebDays;  ///< 1 to kMostWebDays.
  std::int64_t now_s = 0;
};

struct WebKeys {
  bool new_authority =
      false;  ///< Otherwise the certificate was renewed under the one that was there.
  std::int64_t until_s = 0;
  std::string fingerprint;  ///< Of the authority, SHA-256.
};

/// Whether it can stand in a certificate: an address, or the name of a host without wildcards.
/// Error kInvalidArgument.
[[nodiscard]] Status check_web_name(std::string_view name);

/// Makes an authority that can speak for these names alone, and a certificate of it. Where the
/// folder has an authority already, that one signs a new certificate, and browsers need not be told
/// again. The folder is private (0700), keys are 0600. Errors: kInvalidArgument (names, days, the
/// folder has something else in it), kState (the authority has expired or is for other names),
/// kNotFound, kParse, kIo.
[[nodiscard]] Result<WebKeys> make_web_keys(const NewWebKeys& wanted);

}  // namespace rave::keys
