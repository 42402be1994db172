// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

#include "rave/base/result.hpp"

// Where what lies in a set of keys.
namespace rave::keys {

inline constexpr const char* kCaFolder = "ca";
inline constexpr const char* kAuthority = "authority.pem";
inline constexpr const char* kAuthorityKey = "authority_key.pem";

// The names that BusConfig::security asks for.
inline constexpr const char* kIdentityCa = "identity_ca.pem";
inline constexpr const char* kIdentity = "identity.pem";
inline constexpr const char* kIdentityKey = "identity_key.pem";
inline constexpr const char* kPermissionsCa = "permissions_ca.pem";
inline constexpr const char* kGovernance = "governance.p7s";
inline constexpr const char* kPermissions = "permissions.p7s";

inline constexpr std::int64_t kDay_s = 86'400;

/// Largest accepted size of a file of a set.
inline constexpr std::size_t kLargestFile = std::size_t{1} << 20;

/// `lab-keys/` and `lab-keys` are the same folder, whose parent is `.`.
[[nodiscard]] std::filesystem::path without_slash(const std::filesystem::path& folder);
[[nodiscard]] std::filesystem::path parent_of(const std::filesystem::path& folder);

/// Checks that the folder has the certificate of an authority. Error kNotFound, with the nearest
/// name.
[[nodiscard]] Status check_set(const std::filesystem::path& folder);

}  // namespace rave::keys
