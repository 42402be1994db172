// SPDX-License-Identifier: Apache-2.0
#include "scenario_rights.hpp"

namespace rave::gui_server {
namespace {

Reach reach_of_rule(const config::GuiRightFile& rule) {
  switch (rule.reach) {
    case config::GuiReach::kNone:
      return {Reach::Kind::kNone, {}};
    case config::GuiReach::kOwn:
      return {Reach::Kind::kOwn, {}};
    case config::GuiReach::kAll:
      return {Reach::Kind::kAll, {}};
    case config::GuiReach::kTeams:
      return {Reach::Kind::kTeams, {rule.teams.begin(), rule.teams.end()}};
  }
  return {};
}

}  // namespace

Rights rights_of(const config::GuiFile& gui) {
  static_assert(static_cast<std::size_t>(config::GuiClass::kProbe) + 1 == kInfoClasses);
  Rights rights;
  for (const config::GuiRightFile& rule : gui.rights) {
    for (const config::GuiClass what : rule.classes) {
      // Both are in the same order, which a test compares by their names.
      const auto info = static_cast<InfoClass>(what);
      if (rule.user) {
        rights.set_user(rule.user->value, info, reach_of_rule(rule));
      } else {
        const bool commander = rule.role == config::GuiRole::kCommander;
        static_cast<void>(
            rights.set(commander ? Role::kCommander : Role::kObserver, info, reach_of_rule(rule)));
      }
    }
  }
  return rights;
}

}  // namespace rave::gui_server
