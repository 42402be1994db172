// SPDX-License-Identifier: Apache-2.0
#include "visitors/rights_desk.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "rave/base/control_characters.hpp"
#include "rave/base/file.hpp"
#include "rave/gui_server/accounts.hpp"

namespace rave::gui_server {
namespace {

constexpr std::size_t kMostKept = 10'000;

nlohmann::ordered_json reach_json(const Reach& reach) {
  if (reach.kind != Reach::Kind::kTeams) return std::string(kReaches.of(reach.kind));
  return reach.teams;
}

bool same_cell(const RightChange& a, const RightChange& b) {
  return a.role == b.role && a.user == b.user && a.what == b.what;
}

}  // namespace

Result<RightsDesk> RightsDesk::open(std::filesystem::path folder) {
  RightsDesk desk;
  desk.folder_ = std::move(folder);
  std::error_code error;
  const auto file = desk.folder_ / "rights";
  if (desk.folder_.empty() || !std::filesystem::exists(file, error)) return desk;
  RAVE_TRY_ASSIGN(const std::string text, read_file(file, std::size_t{4} << 20U));
  RAVE_TRY_ASSIGN(desk.kept_, parse_rights(text, file.string()));
  return desk;
}

void RightsDesk::begin(const std::string& run, const Rights& scenario,
                       std::shared_ptr<const Cast> cast) {
  // It is a column of the file of rights.
  run_ = without_control_characters(run, "?");
  scenario_ = scenario;
  cast_ = std::move(cast);
  renew();
}

void RightsDesk::renew() {
  rights_ = scenario_;
  for (const KeptChange& kept : kept_) {
    if (kept.run == run_) apply(kept.change);
  }
  views_.clear();
  ++revision_;
}

void RightsDesk::apply(const RightChange& change) {
  if (!change.role) {
    rights_.set_user(change.user, change.what, change.reach);
  } else if (change.reach) {
    static_cast<void>(rights_.set(*change.role, change.what, *change.reach));
  }
}

Status RightsDesk::change(const RightChange& change) {
  if (change.role == Role::kSuperUser) {
    return fail(ErrorCode::kInvalidArgument, "a super-user has every right, always");
  }
  if (!change.role) RAVE_TRY(check_user_name(change.user));
  if (change.reach && change.reach->kind == Reach::Kind::kTeams) {
    RAVE_TRY(parse_teams(Teams{false, change.reach->teams}.text()));
  }
  std::erase_if(kept_, [&](const KeptChange& kept) {
    return kept.run == run_ && same_cell(kept.change, change);
  });
  // Of a user without a reach the line stays: the scenario may have given one, which is taken back.
  if (change.reach || !change.role) kept_.push_back({run_, change});
  // The oldest goes: probably of a run that is not shown any more.
  if (kept_.size() > kMostKept) kept_.erase(kept_.begin());
  renew();
  if (folder_.empty()) return {};
  return write_private_file_atomically(folder_ / "rights", write_rights(kept_));
}

std::set<std::string, std::less<>> RightsDesk::mentioned() const {
  std::set<std::string, std::less<>> names;
  // Those of the scenario also if a change took their rights back: the next change can return them.
  for (const auto& [user, row] : scenario_.users()) names.insert(user);
  for (const KeptChange& kept : kept_) {
    if (!kept.change.role && kept.change.reach) names.insert(kept.change.user);
  }
  return names;
}

std::shared_ptr<const View> RightsDesk::view_of(const Person& person) {
  auto view = std::make_shared<const View>(rights_, person, cast_);
  // By what it permits and not by person, so that pages of equal rights share their frames.
  auto& shared = views_[view->key()];
  if (auto known = shared.lock()) return known;
  shared = view;
  return view;
}

std::string RightsDesk::message(const std::vector<Person>& people) const {
  using Json = nlohmann::ordered_json;
  Json message = {{"type", "rights"},
                  {"classes", Json::array()},
                  {"teams", Json::array()},
                  {"rows", Json::array()},
                  {"people", Json::array()}};
  for (std::size_t i = 0; i < kInfoClasses; ++i) {
    message["classes"].push_back(to_string(static_cast<InfoClass>(i)));
  }
  const std::set<std::string> teams(cast_->teams.begin(), cast_->teams.end());
  message["teams"] = teams;
  for (const Role role : {Role::kObserver, Role::kCommander, Role::kSuperUser}) {
    Json cells = Json::object();
    for (std::size_t i = 0; i < kInfoClasses; ++i) {
      const auto what = static_cast<InfoClass>(i);
      cells[std::string(to_string(what))] = reach_json(rights_.of(role, what));
    }
    message["rows"].push_back({{"role", to_string(role)}, {"cells", std::move(cells)}});
  }
  for (const auto& [user, row] : rights_.users()) {
    Json cells = Json::object();
    for (const auto& [what, reach] : row) cells[std::string(to_string(what))] = reach_json(reach);
    message["rows"].push_back({{"user", user}, {"cells", std::move(cells)}});
  }
  for (const Person& person : people) {
    message["people"].push_back(
        {{"name", person.name}, {"role", to_string(person.role)}, {"teams", person.teams.text()}});
  }
  return message.dump();
}

}  // namespace rave::gui_server
