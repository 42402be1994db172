// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/direct_line/ticket.hpp"

namespace rave::direct_line {

/// Base64 for addresses (RFC 4648, section 5), without padding.
[[nodiscard]] std::string base64_of(std::string_view bytes);
/// Nothing: it is none.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

/// So many random bytes.
[[nodiscard]] std::string random_bytes(std::size_t count);

/// `what`: stands before what is signed, so that no text can be taken for one of another kind.
[[nodiscard]] std::string sign_text(std::string_view what, std::string_view content,
                                    const SigningKey& key);
/// The content. Errors: kParse, kState (the signature does not fit).
[[nodiscard]] Result<std::string> verify_text(std::string_view what, std::string_view text,
                                              const PublicKey& key);

}  // namespace rave::direct_line
