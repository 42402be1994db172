// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

// Secrets and passwords, by libsodium. Any thread.
namespace rave::gui_server {

/// 192 random bits in hexadecimal digits.
[[nodiscard]] std::string new_secret();
/// A hash of such a secret, in hexadecimal digits. Random secrets need no slow hash; looking one up
/// tells nothing of the secret by its time.
[[nodiscard]] std::string hash_of(std::string_view secret);

/// Argon2id; takes 64 MiB and a tenth of a second. Empty: there is not enough memory.
[[nodiscard]] std::string password_hash(std::string_view password);
/// As slow as password_hash(), also if `hash` is empty, for an unknown name.
[[nodiscard]] bool password_fits(std::string_view password, const std::string& hash);
/// Whether a text is such a hash.
[[nodiscard]] bool is_password_hash(std::string_view text);

}  // namespace rave::gui_server
