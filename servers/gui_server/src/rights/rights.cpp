// SPDX-License-Identifier: Apache-2.0
#include "rave/gui_server/rights.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace rave::gui_server {
namespace {

using Kind = Reach::Kind;

/// A line of the table: what it is called, what an observer and a commander may, and in words.
struct Line {
  InfoClass what;
  std::string_view name;
  Kind observer;
  Kind commander;
  std::string_view meaning;
};

/// In the order of InfoClass, because line_of() uses it as index. Stopping reaches further than
/// releasing: a stop is always safe.
constexpr std::array<Line, kInfoClasses> kLines = {{
    {InfoClass::kPose, "pose", Kind::kAll, Kind::kAll,
     "existence, name, shape and reported pose of a robot"},
    {InfoClass::kTruePose, "true_pose", Kind::kNone, Kind::kNone,
     "its true pose in the simulated world"},
    {InfoClass::kReadings, "readings", Kind::kOwn, Kind::kOwn, "its sensors and their readings"},
    {InfoClass::kHybridParts, "hybrid_parts", Kind::kNone, Kind::kOwn,
     "the real and the virtual half of its hybrid sensors"},
    {InfoClass::kObstacles, "obstacles", Kind::kAll, Kind::kAll, "virtual obstacles"},
    {InfoClass::kGoals, "goals", Kind::kOwn, Kind::kOwn, "its goals and paths"},
    {InfoClass::kMaps, "maps", Kind::kOwn, Kind::kOwn, "its maps"},
    {InfoClass::kChat, "chat", Kind::kOwn, Kind::kOwn, "messages about it and to it"},
    {InfoClass::kLog, "log", Kind::kAll, Kind::kAll, "events of visible robots"},
    {InfoClass::kVideo, "video", Kind::kNone, Kind::kOwn, "images of its cameras"},
    {InfoClass::kRecording, "recording", Kind::kNone, Kind::kNone, "the recording of the run"},
    {InfoClass::kStop, "stop", Kind::kNone, Kind::kAll, "stopping it"},
    {InfoClass::kRelease, "release", Kind::kNone, Kind::kOwn, "release after a stop"},
    {InfoClass::kRunControl, "run_control", Kind::kNone, Kind::kNone,
     "pause, step, resume and pace of a run in progress"},
    {InfoClass::kCommand, "command", Kind::kNone, Kind::kOwn,
     "drive it, give it goals, paths and texts, change its parameters"},
    {InfoClass::kEdit, "edit", Kind::kNone, Kind::kNone,
     "add, move and remove virtual obstacles; place simulated robots"},
    {InfoClass::kProbe, "probe", Kind::kNone, Kind::kOwn,
     "try virtual sensors on it; needs `readings`"},
    {InfoClass::kConduct, "conduct", Kind::kNone, Kind::kNone,
     "start, end and restart runs; open recordings"},
}};

const Line& line_of(InfoClass what) { return kLines[static_cast<std::size_t>(what)]; }

const Reach& everything() {
  static const Reach kEverything{Kind::kAll, {}};
  return kEverything;
}

}  // namespace

std::string_view to_string(InfoClass what) noexcept { return line_of(what).name; }

std::optional<InfoClass> class_named(std::string_view word) noexcept {
  for (const Line& line : kLines) {
    if (line.name == word) return line.what;
  }
  return std::nullopt;
}

bool Reach::covers(std::string_view team, const Teams& own) const {
  switch (kind) {
    case Kind::kNone:
      return false;
    case Kind::kOwn:
      return own.has(team);
    case Kind::kAll:
      return true;
    case Kind::kTeams:
      return teams.contains(team);
  }
  return false;
}

bool Reach::covers_all(const Teams& own) const {
  return kind == Kind::kAll || (kind == Kind::kOwn && own.all);
}

Rights::Rights() {
  for (const Line& line : kLines) {
    const auto column = static_cast<std::size_t>(line.what);
    roles_[static_cast<std::size_t>(Role::kObserver)][column].kind = line.observer;
    roles_[static_cast<std::size_t>(Role::kCommander)][column].kind = line.commander;
    roles_[static_cast<std::size_t>(Role::kSuperUser)][column] = everything();
  }
}

Status Rights::set(Role role, InfoClass what, Reach reach) {
  if (role == Role::kSuperUser) {
    return fail(ErrorCode::kInvalidArgument, "a super-user has every right, always");
  }
  roles_[static_cast<std::size_t>(role)][static_cast<std::size_t>(what)] = std::move(reach);
  return {};
}

void Rights::set_user(const std::string& user, InfoClass what, std::optional<Reach> reach) {
  if (reach) {
    users_[user].insert_or_assign(what, *std::move(reach));
    return;
  }
  const auto found = users_.find(user);
  if (found == users_.end()) return;
  found->second.erase(what);
  if (found->second.empty()) users_.erase(found);
}

const Reach& Rights::of(Role role, InfoClass what) const {
  return roles_[static_cast<std::size_t>(role)][static_cast<std::size_t>(what)];
}

const Reach& Rights::of(const Person& person, InfoClass what) const {
  // First, so that no line of a file can take a right from a super-user.
  if (person.role == Role::kSuperUser) return everything();
  // A line of the user's own goes before that of the role. It is for whom the name was given to: an
  // invited person can choose any name that is free.
  const auto user = person.name_given ? users_.find(person.name) : users_.end();
  if (user != users_.end()) {
    if (const auto own = user->second.find(what); own != user->second.end()) return own->second;
  }
  return of(person.role, what);
}

std::string Rights::usual_table() {
  std::string table =
      "| class | observer | commander | super-user | what it is |\n|---|---|---|---|---|\n";
  for (const Line& line : kLines) {
    table += fmt::format("| `{}` | {} | {} | all | {} |\n", line.name, kReaches.of(line.observer),
                         kReaches.of(line.commander), line.meaning);
  }
  return table;
}

}  // namespace rave::gui_server
