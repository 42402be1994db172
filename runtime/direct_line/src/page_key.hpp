// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rave::direct_line {

/// What a page signs with its key to show that it has it: the challenge of the host, the address
/// that the page has dialled (`left.example:8090`), and the ticket.
[[nodiscard]] std::string proof_text(std::string_view challenge, std::string_view address,
                                     std::string_view ticket);

/// Whether `signature` (64 bytes: r and s, as WebCrypto writes it) of `text` was made by the key
/// that belongs to a point of P-256 (65 bytes). ECDSA with SHA-256.
[[nodiscard]] bool page_key_signed(std::string_view point, std::string_view signature,
                                   std::string_view text);

}  // namespace rave::direct_line
