// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/base/result.hpp"
#include "rave/direct_line/ticket.hpp"

// The key of a GUI Server as two files with one line each: `FILE` with the secret half (mode 0600),
// for the server, and `FILE.pub`, for hosts. Any thread.
namespace rave::direct_line {

/// The public key of tickets in the folder of a member of a set of keys (`rave keys new`), where a
/// host looks for it.
inline constexpr const char* kMemberKeyFile = "line.pub";

/// Creates both files with a new key. Errors: kInvalidArgument (one of them exists), kNotFound (no
/// such folder), kIo.
[[nodiscard]] Status make_key_files(const std::filesystem::path& file);
/// Writes only the public half, for hosts. Error kIo.
[[nodiscard]] Status write_public_key(const std::filesystem::path& file, const PublicKey& key);

/// Errors: kNotFound, kIo, kParse (not a key file; the message says if it is the other half); for
/// the secret half also kState (others can read it).
[[nodiscard]] Result<SigningKey> read_signing_key(const std::filesystem::path& file);
[[nodiscard]] Result<PublicKey> read_public_key(const std::filesystem::path& file);

}  // namespace rave::direct_line
