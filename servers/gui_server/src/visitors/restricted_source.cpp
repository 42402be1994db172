// SPDX-License-Identifier: Apache-2.0
#include "visitors/restricted_source.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

namespace rave::gui_server {
namespace {

using BodyJson = nlohmann::ordered_json;

constexpr const char* kNotYours = "Your rights do not include this.";

class RestrictedCursor final : public Cursor {
 public:
  RestrictedCursor(RestrictedSource& source, std::unique_ptr<Cursor> all, const View& view)
      : source_(source), all_(std::move(all)), view_(view) {}

  Status go_to(double time_s) override {
    RAVE_TRY(all_->go_to(time_s));
    poses_ = source_.cut(all_->poses());
    return {};
  }
  [[nodiscard]] const PosesAt& poses() const noexcept override { return poses_; }
  [[nodiscard]] std::vector<ReadingAt> readings(std::span<const LookedAt> sensors,
                                                bool parts) override {
    // Slots of this page count the robots that it sees; those of the source count all.
    std::vector<LookedAt> wanted;
    for (const LookedAt& sensor : sensors) {
      const auto robot = view_.robot_of(sensor.slot);
      if (robot && view_.may_read_sensor(*robot, sensor.sensor)) {
        wanted.push_back({*robot, sensor.sensor});
      }
    }
    if (wanted.empty()) return {};
    std::vector<ReadingAt> mine;
    for (ReadingAt& reading : all_->readings(wanted, parts)) {
      if (view_.reading(reading)) mine.push_back(std::move(reading));
    }
    return mine;
  }
  [[nodiscard]] std::string take_bodies() override {
    return source_.cut_bodies(all_->take_bodies());
  }

 private:
  RestrictedSource& source_;
  std::unique_ptr<Cursor> all_;
  const View& view_;
  PosesAt poses_;
};

/// Of a run in progress: its time belongs to all, so not every user may move it.
class WatchedPlayhead final : public Playhead {
 public:
  explicit WatchedPlayhead(std::unique_ptr<Playhead> all) : all_(std::move(all)) {}
  std::string take(const TransportMessage& /*transport*/, Clock::time_point /*now*/) override {
    return kNotYours;
  }
  PlayState look(Clock::time_point now) override { return all_->look(now); }

 private:
  std::unique_ptr<Playhead> all_;
};

/// The answer of a host as this user gets it: it may name robots that are not seen.
std::string told_to(const View& view, bool good, std::string text) {
  if (view.may_read(text)) return text;
  return good ? "Done." : "The request failed.";
}

/// What a power needs: the right of its name, if there is one.
bool allowed(const View& view, bool live, const std::string& power) {
  const auto what = class_named(power);
  if (what == InfoClass::kRecording) return view.may_all(*what);
  // "Any": a power shows the control on the page. Whether it may be used on one robot is checked
  // for each request.
  if (what) return view.may_any(*what);
  // The powers that are left move time. In a replay each page has its own; that of a run is
  // everybody's.
  return !live || power == "seek" || view.may_all(InfoClass::kRunControl);
}

}  // namespace

RestrictedSource::RestrictedSource(std::shared_ptr<Source> all, std::shared_ptr<const View> view)
    : all_(std::move(all)),
      view_(std::move(view)),
      about_(all_->about()),
      robots_json_(view_->robots_json(all_->robots_json())) {
  if (!view_->may_all(InfoClass::kRecording)) about_.recording.clear();
}

Powers RestrictedSource::powers() const {
  Powers powers = all_->powers();
  std::erase_if(powers.may, [&](const std::string& power) {
    if (allowed(*view_, about_.live, power)) return false;
    powers.why_not[power] = kNotYours;
    return true;
  });
  return powers;
}

void RestrictedSource::take_bodies() const {
  if (has_bodies_ && bodies_revision_ == all_->bodies_revision()) return;
  has_bodies_ = true;
  bodies_revision_ = all_->bodies_revision();
  bodies_json_ = view_->bodies_json(all_->bodies_json());
  for (const BodyJson& body : BodyJson::parse(all_->bodies_json())) {
    if (view_->sees_body(body.at("kind").get<std::string>())) {
      shown_bodies_.insert(body.at("id").get<std::int64_t>());
    }
  }
}

const std::string& RestrictedSource::bodies_json() const noexcept {
  take_bodies();
  return bodies_json_;
}

std::string RestrictedSource::hidden_kinds_json() const {
  return view_->sees_body("virtual") ? "[]" : R"(["virtual"])";
}

std::uint64_t RestrictedSource::bodies_revision() const noexcept { return all_->bodies_revision(); }

std::string RestrictedSource::bodies_changed_since(std::uint64_t revision) const {
  return cut_bodies(all_->bodies_changed_since(revision));
}

std::string RestrictedSource::cut_bodies(const std::string& change) const {
  if (change.empty()) return {};
  // Fails closed: what cannot be read cannot be cut, so nothing is sent.
  const BodyJson all = BodyJson::parse(change, nullptr, false);
  if (!all.is_object()) return {};
  BodyJson mine = {
      {"type", "scene_change"}, {"set", BodyJson::array()}, {"gone", BodyJson::array()}};
  for (const BodyJson& body : all.at("set")) {
    if (!view_->sees_body(body.at("kind").get<std::string>())) continue;
    const auto id = body.at("id").get<std::int64_t>();
    shown_bodies_.insert(id);
    mine["set"].push_back(body);
    mine["set"].back()["id"] = view_->body_id(id);
  }
  for (const BodyJson& id : all.at("gone")) {
    // A number that was never shown would tell that a hidden body existed.
    if (shown_bodies_.contains(id)) mine["gone"].push_back(view_->body_id(id));
  }
  // That something changed which is withheld is not told either.
  if (mine["set"].empty() && mine["gone"].empty()) return {};
  return mine.dump();
}

void RestrictedSource::take_events() const {
  const std::uint64_t revision = all_->events_revision();
  if (has_events_ && revision == events_revision_) return;
  const std::size_t first = has_events_ ? all_->events_changed_since(events_revision_) : 0;
  // A repetition changes an event that is there already, so all from `first` on are taken anew.
  while (!event_places_.empty() && event_places_.back() >= first) {
    event_places_.pop_back();
    events_.pop_back();
  }
  const auto all = all_->events();
  for (std::size_t i = first; i < all.size(); ++i) {
    if (auto mine = view_->event(all[i])) {
      events_.push_back(*std::move(mine));
      event_places_.push_back(i);
    }
  }
  has_events_ = true;
  events_revision_ = revision;
}

std::span<const LogEvent> RestrictedSource::events() const noexcept {
  take_events();
  return events_;
}

std::uint64_t RestrictedSource::events_revision() const noexcept { return all_->events_revision(); }

std::size_t RestrictedSource::events_changed_since(std::uint64_t revision) const noexcept {
  take_events();
  const std::size_t first = all_->events_changed_since(revision);
  // The index counts the events of this user, that of the source all events.
  const auto place = std::lower_bound(event_places_.begin(), event_places_.end(), first);
  return static_cast<std::size_t>(place - event_places_.begin());
}

PosesAt RestrictedSource::cut(const PosesAt& all) {
  if (all.serial == 0) return view_->poses(all);
  // All pages of these rights share this object; each moment is cut once.
  if (shared_.serial != all.serial || shared_.time_s != all.time_s) {
    shared_ = view_->poses(all);
  }
  return shared_;
}

std::unique_ptr<Cursor> RestrictedSource::open_cursor() {
  return std::make_unique<RestrictedCursor>(*this, all_->open_cursor(), *view_);
}

std::unique_ptr<Playhead> RestrictedSource::open_playhead() {
  auto playhead = all_->open_playhead();
  if (!about_.live || view_->may_all(InfoClass::kRunControl)) return playhead;
  return std::make_unique<WatchedPlayhead>(std::move(playhead));
}

std::uint64_t RestrictedSource::hosts_revision() const noexcept {
  // The list of hosts counts their robots, also those that are withheld.
  return view_->may_all(InfoClass::kPose) ? all_->hosts_revision() : 0;
}

const std::string& RestrictedSource::hosts_json() const noexcept {
  return view_->may_all(InfoClass::kPose) ? all_->hosts_json() : Source::hosts_json();
}

/// `global TEAM` is what that team knows together (maps::TeamMaps).
bool RestrictedSource::may_global(const std::string& name) const {
  constexpr std::string_view kOfTeam = "global ";
  if (!view_->may_some(InfoClass::kMaps) || !view_->may_read(name)) return false;
  return !name.starts_with(kOfTeam) ||
         view_->may_of_team(InfoClass::kMaps, std::string_view(name).substr(kOfTeam.size()));
}

std::vector<MapName> RestrictedSource::map_names() const {
  std::vector<MapName> mine;
  for (MapName& name : all_->map_names()) {
    if (name.global()) {
      if (may_global(name.name)) mine.push_back(name);
    } else if (view_->may(InfoClass::kMaps, name.slot)) {
      mine.push_back({*view_->slot_of(name.slot), std::move(name.name)});
    }
  }
  return mine;
}

const MapShown* RestrictedSource::map(const MapName& name) const {
  if (name.global()) {
    return may_global(name.name) ? all_->map(name) : nullptr;
  }
  const auto robot = view_->robot_of(name.slot);
  if (!robot || !view_->may(InfoClass::kMaps, *robot)) return nullptr;
  return all_->map({*robot, view_->cast().names[*robot]});
}

std::string RestrictedSource::virtual_sensors_json() {
  return view_->may_any(InfoClass::kProbe) ? all_->virtual_sensors_json() : "[]";
}

Result<ProbeMade> RestrictedSource::probe(const ProbeRequest& request) {
  const auto robot = view_->robot_of(request.slot);
  const bool may =
      robot && view_->may(InfoClass::kProbe, *robot) && view_->may(InfoClass::kReadings, *robot);
  if (!may) return fail(ErrorCode::kState, "{}", kNotYours);
  ProbeRequest mine = request;
  mine.slot = *robot;
  mine.without_obstacles = !view_->may_any(InfoClass::kObstacles);
  return all_->probe(mine);
}

void RestrictedSource::halt(const HaltMessage& halt, const Author& author, Reply reply) {
  const InfoClass what = halt.stop ? InfoClass::kStop : InfoClass::kRelease;
  HaltMessage mine;
  mine.stop = halt.stop;
  for (const std::uint32_t slot : halt.slots) {
    const auto robot = view_->robot_of(slot);
    // All or none: a stop of half of what was marked would look like one that worked.
    if (!robot || !view_->may(what, *robot)) return reply(false, kNotYours);
    mine.slots.push_back(*robot);
  }
  if (halt.slots.empty() && !view_->may_all(what)) {
    // "All" is all of those that they may.
    for (std::uint32_t slot = 0; slot < view_->robots(); ++slot) {
      const std::uint32_t robot = *view_->robot_of(slot);
      if (view_->may(what, robot)) mine.slots.push_back(robot);
    }
    if (mine.slots.empty()) return reply(false, kNotYours);
  }
  all_->halt(mine, author, [reply = std::move(reply), view = view_](bool good, std::string text) {
    reply(good, told_to(*view, good, std::move(text)));
  });
}

namespace {

/// Who has no right to see an obstacle must not learn of it by moving it.
bool may_edit(const View& view) {
  return view.may_any(InfoClass::kEdit) && view.may_any(InfoClass::kObstacles);
}

/// The place of a command for one of its robots.
CommandMessage part_of(const CommandMessage& command, std::size_t i, std::uint32_t robot) {
  CommandMessage part = command;
  part.slots = {robot};
  part.action = command.action_for(i);
  part.points.clear();
  return part;
}

}  // namespace

void RestrictedSource::command(const CommandMessage& command, const Author& author,
                               const SlotReply& reply) {
  if (command.of_obstacle()) {
    if (!may_edit(*view_)) return reply(kNoSlot, false, kNotYours);
    return all_->command(command, author,
                         [reply, view = view_](std::uint32_t slot, bool good, std::string text) {
                           reply(slot, good, told_to(*view, good, std::move(text)));
                         });
  }
  const InfoClass what = command.is<request::Place>() ? InfoClass::kEdit : InfoClass::kCommand;
  for (std::size_t i = 0; i < command.slots.size(); ++i) {
    const std::uint32_t slot = command.slots[i];
    const auto robot = view_->robot_of(slot);
    if (!robot || !view_->may(what, *robot)) {
      reply(slot, false, kNotYours);
      continue;
    }
    // Robot by robot, because some may be refused, and points belong to places in the list.
    all_->command(part_of(command, i, *robot), author,
                  [reply, view = view_, slot](std::uint32_t, bool good, std::string text) {
                    reply(slot, good, told_to(*view, good, std::move(text)));
                  });
  }
}

std::vector<DriveState> RestrictedSource::leases_changed_since(std::uint64_t revision) const {
  std::vector<DriveState> mine;
  for (DriveState& state : all_->leases_changed_since(revision)) {
    const auto slot = view_->slot_of(state.slot);
    if (!slot) continue;
    const std::uint32_t robot = std::exchange(state.slot, *slot);
    if (!view_->may(InfoClass::kCommand, robot)) {
      state.takes.clear();
      state.hand_over.reset();
      state.values.clear();
    }
    // It tells what the sensors of the robot read.
    if (!view_->may(InfoClass::kReadings, robot)) state.shadow.reset();
    if (!view_->may(InfoClass::kGoals, robot)) state.order.clear();
    mine.push_back(std::move(state));
  }
  return mine;
}

}  // namespace rave::gui_server
