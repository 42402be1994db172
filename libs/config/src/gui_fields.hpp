// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "file_checks.hpp"
#include "rave/config/gui_file.hpp"
#include "robot_fields.hpp"

// The description of `gui:` in scenario files.
namespace rave::config {

constexpr auto enum_names(EnumTag<GuiRole> /*tag*/) {
  return std::array{EnumName{GuiRole::kObserver, "observer"},
                    EnumName{GuiRole::kCommander, "commander"}};
}

constexpr auto enum_names(EnumTag<GuiClass> /*tag*/) {
  return std::array{EnumName{GuiClass::kPose, "pose"},
                    EnumName{GuiClass::kTruePose, "true_pose"},
                    EnumName{GuiClass::kReadings, "readings"},
                    EnumName{GuiClass::kHybridParts, "hybrid_parts"},
                    EnumName{GuiClass::kObstacles, "obstacles"},
                    EnumName{GuiClass::kGoals, "goals"},
                    EnumName{GuiClass::kMaps, "maps"},
                    EnumName{GuiClass::kChat, "chat"},
                    EnumName{GuiClass::kLog, "log"},
                    EnumName{GuiClass::kVideo, "video"},
                    EnumName{GuiClass::kRecording, "recording"},
                    EnumName{GuiClass::kStop, "stop"},
                    EnumName{GuiClass::kRelease, "release"},
                    EnumName{GuiClass::kRunControl, "run_control"},
                    EnumName{GuiClass::kCommand, "command"},
                    EnumName{GuiClass::kEdit, "edit"},
                    EnumName{GuiClass::kProbe, "probe"},
                    EnumName{GuiClass::kConduct, "conduct"}};
}

constexpr auto enum_names(EnumTag<GuiReach> /*tag*/) {
  return std::array{EnumName{GuiReach::kNone, "none"}, EnumName{GuiReach::kOwn, "own"},
                    EnumName{GuiReach::kAll, "all"}, EnumName{GuiReach::kTeams, "teams"}};
}

template <class V>
void describe(V& v, GuiRightFile& c) {
  v.field("role", c.role, {.doc = "Role whose rights change; null: see `user`."});
  v.field("user", c.user, {.doc = "User whose rights change, with any role; null: see `role`."});
  v.required("classes", c.classes,
             {.doc = "Classes of information or requests that are granted or withdrawn.",
              .min_items = 1,
              .max_items = kGuiClasses});
  v.required(
      "reach", c.reach,
      {.doc =
           "Robots that the change applies to: none, own teams, all, or the robots of `teams`."});
  v.field("teams", c.teams,
          {.doc = "Names of teams; used with `reach: teams`.", .max_items = 1000});
}

void validate(const GuiRightFile& c, CheckContext& check);

template <class V>
void describe(V& v, GuiComponentFile& c) {
  v.required("module", c.module, {.doc = "An ES module (`.js` or `.mjs`), beside this file."});
  v.field("roles", c.roles,
          {.doc = "Who gets it beside super-users; empty: super-users alone.", .max_items = 2});
}

void validate(const GuiComponentFile& c, CheckContext& check);

template <class V>
void describe(V& v, GuiFile& c) {
  v.field("file", c.file,
          {.doc = "File with the keys below, relative to this one; then they are not here."});
  v.field("rights", c.rights,
          {.doc = "Changes of the default rights; a later change overrides an earlier one.",
           .max_items = 1000});
  v.field("relay", c.relay,
          {.doc = "Orders may go through the GUI Server where a page has no direct line to a host; "
                  "robots that are driven so stop when the server ends. STOP always may."});
  v.field("components", c.components,
          {.doc = "Panels that the page loads while it runs.", .max_items = 50});
}

void validate(const GuiFile& c, CheckContext& check);

}  // namespace rave::config
