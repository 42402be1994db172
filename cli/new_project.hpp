// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::cli {

/// What `rave new` makes: a robot program, a driver (a virtual sensor), or a panel of the page.
enum class ProjectKind { kProgram, kDriver, kPanel };

/// `program`, `driver` or `panel`; kInvalidArgument for anything else, naming the nearest one.
[[nodiscard]] Result<ProjectKind> parse_project_kind(std::string_view text);

/// The name of the class in a project: `avoid_walls` gives `AvoidWalls`.
[[nodiscard]] std::string class_name_of(std::string_view project_name);

/// Success if `name` can name a plug-in, its files and its CMake target: lower_snake_case, at most
/// 48 characters, no name that CMake keeps for itself. Otherwise kInvalidArgument.
[[nodiscard]] Status check_project_name(std::string_view name);

/// Makes the folder `target_dir` with a project that builds outside the tree against the installed
/// package. `template_dir` holds the folders `program`, `driver` and `panel`; in the names and the
/// text of their files `@NAME@` becomes `name` and `@CLASS@` the class name. Either the whole
/// folder comes into being or nothing does. Errors: kInvalidArgument (name, or `target_dir`
/// exists), kNotFound (no templates), kIo.
[[nodiscard]] Status create_project(ProjectKind kind, const std::string& name,
                                    const std::filesystem::path& template_dir,
                                    const std::filesystem::path& target_dir);

}  // namespace rave::cli
