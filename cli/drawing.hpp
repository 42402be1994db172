// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "input_file.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// Writes the picture of a file, as the ending of `path` says an SVG or a PNG: a robot with its
/// sensors, or a world with the robots at their start and what their range sensors read there.
/// `built` comes from `input`; its catalogue still lives. Real devices are not opened. Errors:
/// kInvalidArgument for other endings.
[[nodiscard]] Status draw(const InputFile& input, runtime::BuiltScenario built,
                          const std::filesystem::path& path);

}  // namespace rave::cli
