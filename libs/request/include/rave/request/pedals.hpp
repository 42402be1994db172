// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace rave::request {

/// What a person does with a car; units as in pedals_command().
struct Pedals {
  double steering = 0;
  double throttle = 0;
  double brake = 0;
  double gear = 1;
  /// Whether it is a point of what a car has: shares within their ranges, and one of three gears.
  [[nodiscard]] bool is_valid() const noexcept {
    return steering >= -1 && steering <= 1 && throttle >= 0 && throttle <= 1 && brake >= 0 &&
           brake <= 1 && (gear == -1 || gear == 0 || gear == 1);
  }
  friend bool operator==(const Pedals&, const Pedals&) = default;
};

/// @{ Pedals as a struct of the bus has them.
template <class Wire>
void put_pedals(const std::optional<Pedals>& pedals, Wire& wire) {
  const Pedals given = pedals.value_or(Pedals{});
  wire = {};
  wire.given = pedals.has_value();
  wire.steering = given.steering;
  wire.throttle = given.throttle;
  wire.brake = given.brake;
  wire.gear = given.gear;
}
template <class Wire>
[[nodiscard]] std::optional<Pedals> pedals_of(const Wire& wire) {
  if (!wire.given) return std::nullopt;
  return Pedals{wire.steering, wire.throttle, wire.brake, wire.gear};
}
/// @}

}  // namespace rave::request
