// SPDX-License-Identifier: Apache-2.0
#include "visitors/view.hpp"

#include <sodium.h>

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

#include "rave/base/check.hpp"
#include "rave/base/plain_name.hpp"
#include "rave/onlook/command_row.hpp"

namespace rave::gui_server {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::size_t column(InfoClass what) { return static_cast<std::size_t>(what); }

/// A key of this process, so that a page cannot compute back from the number of a body to its
/// place.
const std::array<unsigned char, crypto_shorthash_KEYBYTES>& body_key() {
  static const auto kKey = [] {
    RAVE_CHECK(sodium_init() >= 0);
    std::array<unsigned char, crypto_shorthash_KEYBYTES> fresh{};
    crypto_shorthash_keygen(fresh.data());
    return fresh;
  }();
  return kKey;
}

}  // namespace

Cast cast_of(const std::string& robots_json, const std::string& bodies_json) {
  Cast cast;
  for (const OrderedJson& robot : OrderedJson::parse(robots_json)) {
    const auto index = static_cast<std::uint32_t>(cast.names.size());
    cast.names.push_back(robot.at("name").get<std::string>());
    cast.teams.push_back(robot.at("team").get<std::string>());
    std::uint32_t number = 0;
    for (const OrderedJson& sensor : robot.at("sensors")) {
      // Readings of these name other robots, which this user may not see; reading() cuts them.
      if (sensor.at("kind") == "neighbours") cast.neighbour_sensors.insert({index, number});
      ++number;
    }
  }
  for (const OrderedJson& body : OrderedJson::parse(bodies_json)) {
    if (body.at("kind") == "virtual") cast.virtual_obstacles.push_back(body.at("name"));
  }
  return cast;
}

View::View(const Rights& rights, const Person& person, std::shared_ptr<const Cast> cast)
    : cast_(std::move(cast)) {
  for (const std::string& team : cast_->teams) {
    const auto found = std::find(teams_.begin(), teams_.end(), team);
    team_of_.push_back(static_cast<std::uint32_t>(found - teams_.begin()));
    if (found == teams_.end()) teams_.push_back(team);
  }
  note(rights, person);
  slots_.assign(cast_->names.size(), -1);
  for (std::uint32_t robot = 0; robot < slots_.size(); ++robot) {
    if (covers_[column(InfoClass::kPose)][team_of_[robot]]) {
      slots_[robot] = static_cast<std::int64_t>(shown_.size());
      shown_.push_back(robot);
    } else {
      hidden_.insert(cast_->names[robot]);
    }
  }
  if (!may_any(InfoClass::kObstacles)) {
    hidden_.insert(cast_->virtual_obstacles.begin(), cast_->virtual_obstacles.end());
  }
}

void View::note(const Rights& rights, const Person& person) {
  for (std::size_t i = 0; i < kInfoClasses; ++i) {
    const Reach& reach = rights.of(person, static_cast<InfoClass>(i));
    any_[i] = reach.kind != Reach::Kind::kNone;
    all_[i] = reach.covers_all(person.teams);
    whole_ = whole_ && all_[i];
    // Equal keys mean equal views: pages with the same key share messages and frames.
    key_ += any_[i] ? (all_[i] ? 'a' : 's') : 'n';
    for (const std::string& team : teams_) {
      covers_[i].push_back(reach.covers(team, person.teams));
      key_ += covers_[i].back() ? '1' : '0';
    }
  }
}

std::optional<std::uint32_t> View::robot_of(std::uint32_t slot) const {
  if (slot >= shown_.size()) return std::nullopt;
  return shown_[slot];
}

std::optional<std::uint32_t> View::slot_of(std::uint32_t robot) const {
  if (robot >= slots_.size() || slots_[robot] < 0) return std::nullopt;
  return static_cast<std::uint32_t>(slots_[robot]);
}

bool View::may(InfoClass what, std::uint32_t robot) const {
  return slot_of(robot).has_value() && covers_[column(what)][team_of_[robot]];
}

bool View::may_read_sensor(std::uint32_t robot, std::uint32_t sensor) const {
  if (sensor == onlook::kCommandsOf) return may(InfoClass::kGoals, robot);
  if (probe::is_probe(sensor) && !may(InfoClass::kProbe, robot)) return false;
  return may(InfoClass::kReadings, robot);
}

bool View::may_any(InfoClass what) const { return any_[column(what)]; }
bool View::may_some(InfoClass what) const {
  return may_all(what) || std::any_of(shown_.begin(), shown_.end(),
                                      [&](std::uint32_t robot) { return may(what, robot); });
}
bool View::may_of_team(InfoClass what, std::string_view team) const {
  const auto found = std::ranges::find(teams_, team);
  return found == teams_.end() ||
         covers_[column(what)][static_cast<std::size_t>(found - teams_.begin())];
}
bool View::may_all(InfoClass what) const { return all_[column(what)]; }

PosesAt View::poses(const PosesAt& all) const {
  // Made anew, so that what is withheld is not copied in the first place.
  PosesAt mine{all.serial, all.time_s, all.step, {}, {}, all.taken_us};
  mine.robots.reserve(shown_.size());
  for (const std::uint32_t robot : shown_) {
    // The poses may be of a moment when the run had fewer robots than the roster.
    const bool given = robot < all.robots.size();
    mine.robots.push_back(given ? all.robots[robot] : RobotState{});
  }
  if (all.truth.empty() || !may_some(InfoClass::kTruePose)) return mine;
  mine.truth.reserve(shown_.size());
  for (const std::uint32_t robot : shown_) {
    const bool given = robot < all.truth.size() && may(InfoClass::kTruePose, robot);
    mine.truth.push_back(given ? all.truth[robot] : RobotState{});
  }
  return mine;
}

bool View::reading(ReadingAt& reading) const {
  const std::uint32_t robot = reading.slot;
  if (!may_read_sensor(robot, reading.sensor)) return false;
  if (reading.part != 0 && !may(InfoClass::kHybridParts, robot)) return false;
  reading.slot = *slot_of(robot);
  const bool names_robots = probe::is_probe(reading.sensor)
                                ? (reading.sensor & probe::kNamesRobotsBit) != 0
                                : cast_->neighbour_sensors.contains({robot, reading.sensor});
  if (!names_robots || reading.fields == 0) return true;
  // The first field of a row is the other robot, as the run counts them.
  std::vector<float> kept;
  std::uint32_t rows = 0;
  for (std::size_t row = 0; row + reading.fields <= reading.values.size(); row += reading.fields) {
    const float other = reading.values[row];
    const auto slot =
        // Readings are floats; a conversion of NaN or a number out of range would be undefined.
        other >= 0 && other < 1e9F ? slot_of(static_cast<std::uint32_t>(other)) : std::nullopt;
    if (!slot) continue;
    const auto begin = reading.values.begin() + static_cast<std::ptrdiff_t>(row);
    kept.insert(kept.end(), begin, begin + reading.fields);
    kept[kept.size() - reading.fields] = static_cast<float>(*slot);
    ++rows;
  }
  reading.values = std::move(kept);
  reading.rows = rows;
  return true;
}

bool View::names_hidden(std::string_view text) const {
  if (hidden_.empty()) return false;
  std::string word;
  for (std::size_t i = 0; i <= text.size(); ++i) {
    if (i < text.size() && is_plain(text[i], "-_")) {
      word.push_back(text[i]);
    } else if (!word.empty()) {
      if (hidden_.contains(word)) return true;
      word.clear();
    }
  }
  return false;
}

/// What an event tells of a robot beside that something happened: what people said to it and what
/// it answered, or where it was sent.
std::optional<InfoClass> View::told_by(const LogEvent& event) {
  if (event.kind == "said") return InfoClass::kChat;
  if (event.kind != "ordered") return std::nullopt;
  const bool text = event.text.find(": ordered, text: ") != std::string::npos;
  return text ? InfoClass::kChat : InfoClass::kGoals;
}

std::optional<LogEvent> View::event(const LogEvent& event) const {
  const auto told = told_by(event);
  LogEvent mine = event;
  mine.slots.clear();
  if (event.slots.empty() && !may_any(InfoClass::kLog)) return std::nullopt;
  // An event of two robots is shown only to who may see both: half of it would name the other.
  for (const std::uint32_t robot : event.slots) {
    if (!may(InfoClass::kLog, robot)) return std::nullopt;
    if (told && !may(*told, robot)) return std::nullopt;
    mine.slots.push_back(*slot_of(robot));
  }
  if (names_hidden(event.text)) return std::nullopt;
  // As with the message `hosts`: names of processes tell how the whole is divided. And a number of
  // contacts counts those of withheld robots.
  const bool of_all = event.kind.starts_with("process ") || event.kind == "contact";
  if (of_all && event.slots.empty() && !may_all(InfoClass::kPose)) return std::nullopt;
  // Obstacles that came later are none of the names that are known.
  if (!may_any(InfoClass::kObstacles) && event.slots.empty() &&
      (event.kind + event.text).find("obstacle") != std::string::npos) {
    return std::nullopt;
  }
  return mine;
}

std::string View::robots_json(const std::string& all) const {
  if (whole_) return all;
  const OrderedJson robots = OrderedJson::parse(all);
  OrderedJson mine = OrderedJson::array();
  for (const std::uint32_t robot : shown_) {
    OrderedJson one = robots.at(robot);
    if (!may(InfoClass::kReadings, robot)) {
      one["sensors"] = OrderedJson::array();
      if (one.contains("twin")) one["twin"]["sensors"] = OrderedJson::array();
    }
    if (!may(InfoClass::kCommand, robot)) {
      one["yours"] = false;
      one.erase("parameters");
    }
    if (may_any(InfoClass::kStop) && !may(InfoClass::kStop, robot)) one["stoppable"] = false;
    mine.push_back(std::move(one));
  }
  return mine.dump();
}

std::string View::bodies_json(const std::string& all) const {
  if (whole_) return all;
  OrderedJson mine = OrderedJson::array();
  for (const OrderedJson& body : OrderedJson::parse(all)) {
    if (!sees_body(body.at("kind").get<std::string>())) continue;
    mine.push_back(body);
    mine.back()["id"] = body_id(body.at("id").get<std::int64_t>());
  }
  return mine.dump();
}

bool View::sees_body(std::string_view kind) const {
  return kind != "virtual" || may_any(InfoClass::kObstacles);
}

std::int64_t View::body_id(std::int64_t id) const {
  if (whole_) return id;
  std::array<unsigned char, sizeof id> bytes{};
  std::memcpy(bytes.data(), &id, sizeof id);
  std::array<unsigned char, crypto_shorthash_BYTES> hash{};
  // SipHash-2-4 with a secret key. Numbers of bodies count up, so gaps would tell how many are
  // hidden.
  crypto_shorthash(hash.data(), bytes.data(), bytes.size(), body_key().data());
  std::uint64_t number = 0;
  std::memcpy(&number, hash.data(), sizeof number);
  // As many bits as numbers of a page hold.
  return static_cast<std::int64_t>(number >> 12U);
}

}  // namespace rave::gui_server
