// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "input_file.hpp"
#include "rave/assemble/build.hpp"
#include "rave/base/result.hpp"
#include "rave/report/picture.hpp"

namespace rave::cli {

/// The picture of a file: a robot with its sensors, or a world with the robots at their start and
/// what their range sensors read there. `built` comes from `input`; its catalogue still lives.
/// Real devices are not opened.
[[nodiscard]] Result<report::Picture> draw(const InputFile& input, runtime::BuiltScenario built);

/// Writes an SVG or a PNG, as the ending of the path says. Errors: kInvalidArgument for others.
Status write_picture(const report::Picture& picture, const std::filesystem::path& path);

}  // namespace rave::cli
