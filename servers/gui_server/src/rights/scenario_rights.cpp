// SPDX-License-Identifier: Apache-2.0
#include "rights/scenario_rights.hpp"

namespace rave::gui_server {

Rights rights_of(const config::GuiFile& gui) {
  Rights rights;
  for (const config::GuiRightFile& rule : gui.rights) {
    Reach reach{rule.reach, {}};
    for (const auto& team : rule.teams) reach.teams.insert(team.value);
    for (const InfoClass what : rule.classes) {
      if (rule.user) {
        rights.set_user(rule.user->value, what, reach);
      } else {
        const bool commander = rule.role == config::GuiRole::kCommander;
        static_cast<void>(rights.set(commander ? Role::kCommander : Role::kObserver, what, reach));
      }
    }
  }
  return rights;
}

}  // namespace rave::gui_server
