// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::cli {

enum class FileKind { kRobot, kWorld, kScenario };

[[nodiscard]] std::string_view to_string(FileKind kind) noexcept;

/// What a file is, by its keys. Errors: kNotFound, kIo, kParse (no YAML, or none of the keys).
[[nodiscard]] Result<FileKind> recognise(const std::filesystem::path& path);

/// A file that `rave check` was given, as a scenario that can be built.
struct InputFile {
  FileKind kind = FileKind::kScenario;
  std::filesystem::path path;
  /// A robot file becomes one robot at the origin of an empty world. A world file gets a robot far
  /// away, because a scenario needs one.
  config::ExpandedScenario scenario;
};

/// Reads a file of any kind and what it refers to. Places in errors are those of the file.
[[nodiscard]] Result<InputFile> read_input(const std::filesystem::path& path);

/// The file with all defaults, as YAML.
[[nodiscard]] std::string write_input(const InputFile& input);

}  // namespace rave::cli
