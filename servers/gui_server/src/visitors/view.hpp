// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "rave/gui_server/rights.hpp"
#include "rave/gui_server/source.hpp"

// What a user gets of a run. Whatever is withheld is left out here, before anything is encoded.
namespace rave::gui_server {

/// Who and what a run has, as far as rights depend on it. Made from the arrays of `roster` and
/// `scene`; a value.
struct Cast {
  std::vector<std::string> names;  ///< Of robots, by their index.
  std::vector<std::string> teams;  ///< The same.
  /// Sensors whose rows name other robots.
  std::set<LookedAt> neighbour_sensors;
  std::vector<std::string> virtual_obstacles;
};

/// `robots_json`, `bodies_json`: as a Source gives them.
[[nodiscard]] Cast cast_of(const std::string& robots_json, const std::string& bodies_json);

/// The part of a run that a user may see. Its robots have numbers of their own, slots without
/// gaps, so that not even the number of the others can be inferred. Immutable; any thread.
class View {
 public:
  View(const Rights& rights, const Person& person, std::shared_ptr<const Cast> cast);

  /// Equal for people who get the same bytes.
  [[nodiscard]] const std::string& key() const noexcept { return key_; }
  /// Nothing is withheld.
  [[nodiscard]] bool whole() const noexcept { return whole_; }

  /// All robots of the run, also those that are not shown: nothing of it may be sent.
  [[nodiscard]] const Cast& cast() const noexcept { return *cast_; }

  [[nodiscard]] std::uint32_t robots() const noexcept {
    return static_cast<std::uint32_t>(shown_.size());
  }
  /// The robot of a slot, by its index in the run; nothing if there is no such slot.
  [[nodiscard]] std::optional<std::uint32_t> robot_of(std::uint32_t slot) const;
  [[nodiscard]] std::optional<std::uint32_t> slot_of(std::uint32_t robot) const;
  /// Whether a class is given of one robot, which has to be seen at all.
  [[nodiscard]] bool may(InfoClass what, std::uint32_t robot) const;
  /// Whether readings of a sensor of a robot are given: of commanded velocities, `goals`; of
  /// a probe, `probe` as well.
  [[nodiscard]] bool may_read_sensor(std::uint32_t robot, std::uint32_t sensor) const;
  /// Of any robot; of what belongs to no robot at all.
  [[nodiscard]] bool may_any(InfoClass what) const;
  /// Of one robot at least.
  [[nodiscard]] bool may_some(InfoClass what) const;
  /// Of the robots of a team; true for a word that is no team.
  [[nodiscard]] bool may_of_team(InfoClass what, std::string_view team) const;
  /// Of every robot, as the recording and run control need it.
  [[nodiscard]] bool may_all(InfoClass what) const;

  /// In slots. Robots whose true pose is withheld have none.
  [[nodiscard]] PosesAt poses(const PosesAt& all) const;
  /// In slots; false: it is withheld.
  [[nodiscard]] bool reading(ReadingAt& reading) const;
  /// In slots; nothing: it is withheld, or names a robot that is.
  [[nodiscard]] std::optional<LogEvent> event(const LogEvent& event) const;
  /// Robots whose readings are withheld have no sensors.
  [[nodiscard]] std::string robots_json(const std::string& all) const;
  /// Bodies have numbers that tell nothing of how many there are.
  [[nodiscard]] std::string bodies_json(const std::string& all) const;
  [[nodiscard]] std::int64_t body_id(std::int64_t id) const;
  /// Whether bodies of a kind are given.
  [[nodiscard]] bool sees_body(std::string_view kind) const;
  /// Whether a text names no robot that is withheld.
  [[nodiscard]] bool may_read(std::string_view text) const { return !names_hidden(text); }

 private:
  void note(const Rights& rights, const Person& person);
  [[nodiscard]] bool names_hidden(std::string_view text) const;
  [[nodiscard]] static std::optional<InfoClass> told_by(const LogEvent& event);

  std::shared_ptr<const Cast> cast_;  ///< Shared by the views of a run.
  std::vector<std::string> teams_;    ///< Distinct ones.
  std::vector<std::uint32_t> team_of_;
  std::array<std::vector<bool>, kInfoClasses> covers_;  ///< By team.
  std::array<bool, kInfoClasses> any_{};
  std::array<bool, kInfoClasses> all_{};
  std::vector<std::uint32_t> shown_;
  std::vector<std::int64_t> slots_;         ///< By robot; -1: withheld.
  std::unordered_set<std::string> hidden_;  ///< Names that must not be read anywhere.
  std::string key_;
  bool whole_ = true;
};

}  // namespace rave::gui_server
