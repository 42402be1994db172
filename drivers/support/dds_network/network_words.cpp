// SPDX-License-Identifier: Apache-2.0
#include "dds_network/network_words.hpp"

#include <algorithm>

namespace rave::dds_network {

std::vector<std::string> split_peers(std::string_view text) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    std::string_view part = text.substr(0, text.find(','));
    text.remove_prefix(std::min(part.size() + 1, text.size()));
    while (part.starts_with(' ')) part.remove_prefix(1);
    while (part.ends_with(' ')) part.remove_suffix(1);
    if (!part.empty()) parts.emplace_back(part);
  }
  return parts;
}

}  // namespace rave::dds_network
