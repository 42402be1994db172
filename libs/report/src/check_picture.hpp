// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/report/picture.hpp"

namespace rave::report {

/// Refuses what cannot be drawn, naming the first such thing; see write_svg.
[[nodiscard]] Status check_picture(const Picture& picture);

}  // namespace rave::report
