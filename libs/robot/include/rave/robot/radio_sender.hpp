// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace rave {

/// The sender field of a packet of rave/robot/radio_packet.hpp, without validation; 0 if there are
/// too few bytes.
[[nodiscard]] std::uint32_t radio_sender(std::span<const std::byte> packet) noexcept;

}  // namespace rave
