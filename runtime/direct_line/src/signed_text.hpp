// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/direct_line/ticket.hpp"

namespace rave::direct_line {

/// Base64 for addresses (base64url, RFC 4648, section 5), without padding.
[[nodiscard]] std::string base64_of(std::string_view bytes);
/// Empty if `text` is not valid base64url.
[[nodiscard]] std::optional<std::string> from_base64(std::string_view text);

/// `count` random bytes from the system.
[[nodiscard]] std::string random_bytes(std::size_t count);

/// `what` is signed together with the content, so that a text of one kind cannot be used as one of
/// another kind.
[[nodiscard]] std::string sign_text(std::string_view what, std::string_view content,
                                    const SigningKey& key);
/// The content of a signed text. Errors: kParse; kState if the signature is invalid.
[[nodiscard]] Result<std::string> verify_text(std::string_view what, std::string_view text,
                                              const PublicKey& key);

}  // namespace rave::direct_line
