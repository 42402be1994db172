// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rave/config/located.hpp"

namespace rave::config {

/// Whose rights a rule sets. A super-user has every right.
enum class GuiRole : std::uint8_t { kObserver, kCommander };

/// What is given or withheld as a whole.
enum class GuiClass : std::uint8_t {
  kPose,
  kTruePose,
  kReadings,
  kHybridParts,
  kObstacles,
  kGoals,
  kMaps,
  kChat,
  kLog,
  kVideo,
  kRecording,
  kStop,
  kRelease,
  kRunControl,
  kCommand,
  kEdit,
  kProbe,
};

/// Of which robots.
enum class GuiReach : std::uint8_t {
  kNone,
  kOwn,  ///< Those of the user's own teams.
  kAll,
  kTeams,  ///< Those of `teams`.
};

/// One entry of `gui: rights:`; later ones go before earlier ones.
struct GuiRightFile {
  std::optional<GuiRole> role;  ///< Exactly one of role and user is set.
  std::optional<Located<std::string>> user;
  std::vector<GuiClass> classes;
  GuiReach reach = GuiReach::kNone;
  std::vector<std::string> teams;  ///< Of kTeams alone.
  bool operator==(const GuiRightFile&) const = default;
};

/// One entry of `gui: components:`: a panel of the page that the scenario brings along.
struct GuiComponentFile {
  Located<std::string> module;  ///< An ES module; absolute in an expanded scenario.
  std::vector<GuiRole> roles;   ///< Who gets it, beside super-users.
  bool operator==(const GuiComponentFile&) const = default;
};

/// What the page shows to whom. It is no part of the run: processes of one run need not agree.
struct GuiFile {
  std::vector<GuiRightFile> rights;
  bool relay = false;  ///< Orders may go through the GUI Server where there is no direct line.
  std::vector<GuiComponentFile> components;
  bool operator==(const GuiFile&) const = default;
};

}  // namespace rave::config
