// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

// Certificates of the GUI Server for browsers, as a folder:
//
//     web-keys/authority.pem      to be installed in browsers
//     web-keys/authority_key.pem  secret: a holder can impersonate the server
//     web-keys/server.pem, server_key.pem   for `rave gui --certificate ... --key ...`
//
// This authority is unrelated to that of a key set, which signs DDS permissions for years and must
// never be installed in a browser. All functions: any thread, but not two at a time for the same
// folder.
namespace rave::keys {

/// Longest validity of a server certificate that browsers accept.
inline constexpr int kMostWebDays = 397;

struct NewWebKeys {
  std::filesystem::path folder;
  /// Host names and addresses that people type; at least one.
  std::vector<std::string> names;
  int days = kMostWebDays;  ///< 1 to kMostWebDays.
  std::int64_t now_s = 0;
};

struct WebKeys {
  bool new_authority = false;  ///< False: the certificate was renewed under the existing authority.
  std::int64_t until_s = 0;
  std::string fingerprint;  ///< Fingerprint of the authority, SHA-256.
};

/// Checks that a name is valid in a certificate: an address, or a host name without wildcards.
/// Error kInvalidArgument.
[[nodiscard]] Status check_web_name(std::string_view name);

/// Creates an authority that is constrained to these names, and a server certificate signed by it.
/// If the folder already has an authority, that one signs the new certificate, and browsers need no
/// change. The folder is private (0700), keys are 0600. Errors: kInvalidArgument (names, days,
/// other files in the folder), kState (the authority has expired or is for other names), kNotFound,
/// kParse, kIo.
[[nodiscard]] Result<WebKeys> make_web_keys(const NewWebKeys& wanted);

}  // namespace rave::keys
