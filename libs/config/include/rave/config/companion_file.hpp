// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/config/described.hpp"
#include "rave/config/variables.hpp"

namespace rave::config {

struct ExpandedScenario;

/// What a run does when a companion ends before it.
enum class CompanionEnd : std::uint8_t {
  kIgnore,  ///< Reports it and continues.
  kEndRun,
};

/// One entry of `companions:`: another program that `rave run` starts and ends with the run, such
/// as a bridge to a motion capture or the stand-in of a robot. It is not part of the run.
struct CompanionFile {
  Located<std::string> name;
  /// The program and its arguments, without a shell. In an expanded scenario `{scenario}` is
  /// replaced and a program with a `/` has an absolute path.
  Located<std::vector<std::string>> command;
  Variables environment;  ///< Added to the environment of the run; scalars.
  /// A text that its output must contain before the run starts; unset: the run does not wait.
  std::optional<std::string> ready;
  double ready_within_s = 10;
  CompanionEnd on_end = CompanionEnd::kIgnore;
  bool operator==(const CompanionFile&) const = default;
};

/// Replaces `{work}` in companions and in parameters of robots by the folder that the companions of
/// a run share.
void set_work_folder(ExpandedScenario& scenario, const std::filesystem::path& folder);

}  // namespace rave::config
