// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/described.hpp"

namespace rave::config {

/// The role that a rule applies to. A super-user has every right.
enum class GuiRole : std::uint8_t { kObserver, kCommander };

/// A class of data or requests that a rule permits or forbids.
enum class GuiClass : std::uint8_t {
  kPose,         ///< Presence and reported poses of robots.
  kTruePose,     ///< True poses of robots.
  kReadings,     ///< Readings of sensors, as programs receive them.
  kHybridParts,  ///< Halves of hybrid sensors.
  kObstacles,    ///< Virtual obstacles.
  kGoals,
  kMaps,
  kChat,
  kLog,
  kVideo,
  kRecording,   ///< The whole recording file.
  kStop,        ///< Stopping robots.
  kRelease,     ///< Releasing robots that were stopped.
  kRunControl,  ///< Pause, step, resume and pace of a run in progress.
  kCommand,     ///< Orders to robots, and changes of their parameters.
  kEdit,        ///< Adding and moving virtual obstacles; placing simulated robots.
  kProbe,       ///< Probes: trying virtual sensors.
  kConduct,     ///< Starting, ending and restarting runs.
};
inline constexpr std::size_t kGuiClasses = 18;

/// The robots that a rule applies to.
enum class GuiReach : std::uint8_t {
  kNone,
  kOwn,  ///< Robots of the user's own teams.
  kAll,
  kTeams,  ///< Robots of `teams`.
};

/// One entry of `gui: rights:`. Later entries override earlier ones.
struct GuiRightFile {
  std::optional<GuiRole> role;  ///< Exactly one of role and user is set.
  std::optional<Located<std::string>> user;
  std::vector<GuiClass> classes;
  GuiReach reach = GuiReach::kNone;
  std::vector<Located<std::string>> teams;  ///< Used with kTeams only.
  bool operator==(const GuiRightFile&) const = default;
};

/// One entry of `gui: components:`: a panel of the page that the scenario supplies.
struct GuiComponentFile {
  Located<std::string> module;  ///< An ES module; an absolute path in an expanded scenario.
  std::vector<GuiRole> roles;   ///< The roles that get the panel, besides super-users.
  bool operator==(const GuiComponentFile&) const = default;
};

/// The part of a scenario that configures the page: rights and panels. It is not part of the run,
/// so the processes of a run may have different values.
struct GuiFile {
  /// The file that has all of it, as `gui.yaml`; unset in an expanded scenario and in such a file.
  std::optional<Located<std::string>> file;
  std::vector<GuiRightFile> rights;
  bool relay = false;  ///< Orders may go through the GUI Server if there is no direct line.
  std::vector<GuiComponentFile> components;
  bool operator==(const GuiFile&) const = default;
};

/// Reads a file that `gui: file:` names. `file_name` is used in messages. Errors: kParse with
/// file:line:column for errors in its content.
[[nodiscard]] Result<GuiFile> read_gui_text(std::string_view text, std::string_view file_name);

/// Whether the modules of an expanded scenario are files. A run without a page does not need them.
/// Error: kNotFound at the entry of the first that is missing.
[[nodiscard]] Status find_components(const GuiFile& gui);

}  // namespace rave::config
