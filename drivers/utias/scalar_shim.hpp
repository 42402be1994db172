// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace rave::utias {

inline double shim_sin(double angle_rad) noexcept { return std::sin(angle_rad); }
inline double shim_cos(double angle_rad) noexcept { return std::cos(angle_rad); }

}  // namespace rave::utias
