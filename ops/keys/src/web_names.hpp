// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

// Names and addresses of a page as libcrypto takes them for the fields of a certificate. They have
// been checked by check_web_name(), so that nothing of them can pass for another field. Any thread.
namespace rave::keys {

[[nodiscard]] bool is_ipv4(const std::string& name);
[[nodiscard]] bool is_ipv6(const std::string& name);

/// The name constraints of an authority. A kind of name that is not mentioned would be
/// unconstrained, so it gets a name or an address that no machine has.
[[nodiscard]] std::string constraints_for(const std::vector<std::string>& names);

/// The names of a server.
[[nodiscard]] std::string alternatives_for(const std::vector<std::string>& names);

}  // namespace rave::keys
