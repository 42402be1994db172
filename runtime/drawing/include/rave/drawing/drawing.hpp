// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/assemble/build.hpp"
#include "rave/base/result.hpp"
#include "rave/config/any_file.hpp"

namespace rave::drawing {

/// Writes the picture of a file, as the ending of `path` says an SVG or a PNG: a robot with its
/// sensors, or a world with the robots at their start and what their range sensors read there.
/// `built` comes from `input`; its catalogue still lives. Real devices are not opened. Errors:
/// kInvalidArgument for other endings.
[[nodiscard]] Status draw(const config::AnyFile& input, runtime::BuiltScenario built,
                          const std::filesystem::path& path);

}  // namespace rave::drawing
