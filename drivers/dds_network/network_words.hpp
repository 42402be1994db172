// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "rave/bus/config.hpp"

namespace rave::dds_network {

/// The choices of a parameter `multicast`.
inline constexpr std::array<const char*, 3> kMulticasts{"none", "discovery", "data"};

/// What one of kMulticasts means; any other word is `none`.
[[nodiscard]] bus::Multicast multicast_of(std::string_view word) noexcept;

/// The addresses in a parameter `peers`, between commas; blanks around them do not count.
[[nodiscard]] std::vector<std::string> split_peers(std::string_view text);

}  // namespace rave::dds_network
