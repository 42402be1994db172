// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "rave/base/result.hpp"
#include "rave/direct_line/ticket.hpp"

// The key of a GUI Server as two files of one line each: `FILE` with the secret half (0600), for
// the server, and `FILE.pub`, for hosts. Any thread.
namespace rave::direct_line {

/// Makes both with a fresh key. Errors: kInvalidArgument (one of them is there), kIo.
[[nodiscard]] Status make_key_files(const std::filesystem::path& file);
/// Writes the half for hosts alone. Error kIo.
[[nodiscard]] Status write_public_key(const std::filesystem::path& file, const PublicKey& key);

/// Errors of both: kNotFound, kIo, kParse (it is not such a file; if it is the other half, that is
/// said), and of the secret half kState (others can read it).
[[nodiscard]] Result<SigningKey> read_signing_key(const std::filesystem::path& file);
[[nodiscard]] Result<PublicKey> read_public_key(const std::filesystem::path& file);

}  // namespace rave::direct_line
