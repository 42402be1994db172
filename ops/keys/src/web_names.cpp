// SPDX-License-Identifier: Apache-2.0
#include "web_names.hpp"

#include <arpa/inet.h>

namespace rave::keys {

bool is_ipv4(const std::string& name) {
  in_addr ignored{};
  return inet_pton(AF_INET, name.c_str(), &ignored) == 1;
}

bool is_ipv6(const std::string& name) {
  in6_addr ignored{};
  return inet_pton(AF_INET6, name.c_str(), &ignored) == 1;
}

std::string constraints_for(const std::vector<std::string>& names) {
  bool has_host = false;
  bool has_address = false;
  std::string text = "critical";
  for (const std::string& name : names) {
    if (is_ipv4(name)) {
      text += ",permitted;IP:" + name + "/255.255.255.255";
    } else if (is_ipv6(name)) {
      text += ",permitted;IP:" + name + "/ffff:ffff:ffff:ffff:ffff:ffff:ffff:ffff";
    } else {
      text += ",permitted;DNS:" + name;
    }
    const bool address = is_ipv4(name) || is_ipv6(name);
    has_host |= !address;
    has_address |= address;
  }
  // A constraint holds only for the kinds of names that it mentions (RFC 5280, 4.2.1.10). So a kind
  // without a name of its own gets one that no machine can have; `.invalid` is reserved (RFC 2606).
  if (!has_host) text += ",permitted;DNS:none.invalid";
  if (!has_address) text += ",permitted;IP:0.0.0.0/255.255.255.255";
  return text;
}

std::string alternatives_for(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += text.empty() ? "" : ",";
    text += (is_ipv4(name) || is_ipv6(name) ? "IP:" : "DNS:") + name;
  }
  return text;
}

}  // namespace rave::keys
