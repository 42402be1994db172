// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "input_file.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/result.hpp"
#include "rave/report/picture.hpp"

namespace rave::cli {

/// One robot with its sensors: mounting points with their directions and names, fields of view cut
/// to a length that leaves the body to be seen, and in the caption what each sensor is.
[[nodiscard]] Result<report::Picture> draw_one_robot(const InputFile& input,
                                                     runtime::BuiltScenario built);

}  // namespace rave::cli
