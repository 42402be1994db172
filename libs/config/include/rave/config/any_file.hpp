// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::config {

enum class FileKind { kRobot, kWorld, kScenario, kExperiment };

[[nodiscard]] std::string_view to_string(FileKind kind) noexcept;

/// What a file is, by its keys. Errors: kNotFound, kIo, kParse (no YAML, or none of the keys).
[[nodiscard]] Result<FileKind> recognise(const std::filesystem::path& path);

/// A file that `rave check` was given, as a scenario that can be built.
struct AnyFile {
  FileKind kind = FileKind::kScenario;
  std::filesystem::path path;
  /// A robot file becomes one robot at the origin of an empty world. A world file gets a robot far
  /// away, because a scenario needs one.
  ExpandedScenario scenario;
};

/// Reads a robot, world or scenario file and what it refers to. Places in errors are those of the
/// file. `settings` are for scenarios; see apply_settings(). Errors: kInvalidArgument (settings for
/// another kind, an experiment).
[[nodiscard]] Result<AnyFile> read_any_file(const std::filesystem::path& path,
                                            Settings settings = {});

/// The file with all defaults, as YAML.
[[nodiscard]] std::string write_any_file(const AnyFile& input);

}  // namespace rave::config
