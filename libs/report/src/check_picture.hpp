// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/report/picture.hpp"

namespace rave::report {

/// Refuses a picture that cannot be drawn; the error names the first problem; see write_svg.
[[nodiscard]] Status check_picture(const Picture& picture);

}  // namespace rave::report
