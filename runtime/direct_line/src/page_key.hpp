// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace rave::direct_line {

/// The text that a page signs to prove that it has its key: the challenge of the host, the address
/// that the page connected to (`left.example:8090`), and the ticket.
[[nodiscard]] std::string proof_text(std::string_view challenge, std::string_view address,
                                     std::string_view ticket);

/// Whether `signature` is an ECDSA signature with SHA-256 of `text`, made with the key of `point`.
/// The signature has 64 bytes, r and s, as WebCrypto writes it; the point of P-256 has 65 bytes.
[[nodiscard]] bool page_key_signed(std::string_view point, std::string_view signature,
                                   std::string_view text);

}  // namespace rave::direct_line
