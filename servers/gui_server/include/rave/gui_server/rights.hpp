// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/gui_server/person.hpp"

// Who may see and do what: one table, which the documentation prints. Plain values, no threads.
namespace rave::gui_server {

/// A class of information, or of requests, that is given or withheld as a whole.
enum class InfoClass : std::uint8_t {
  kPose,         ///< That a robot is there, and where it says it is.
  kTruePose,     ///< Where it is.
  kReadings,     ///< What its program is given.
  kHybridParts,  ///< The halves of its hybrid sensors.
  kObstacles,    ///< Virtual obstacles.
  kGoals,
  kMaps,
  kChat,
  kLog,
  kVideo,
  kRecording,   ///< The file of the run as a whole.
  kStop,        ///< Stopping robots.
  kRelease,     ///< Releasing robots that were stopped.
  kRunControl,  ///< Pause, step, resume and pace of a run that goes on.
  kCommand,     ///< Driving robots, sending them somewhere, telling and setting them something.
  kEdit,        ///< Adding and moving virtual obstacles, and placing simulated robots.
  kProbe,       ///< Trying virtual sensors.
};
inline constexpr std::size_t kInfoClasses = 17;

[[nodiscard]] std::string_view to_string(InfoClass what) noexcept;
[[nodiscard]] std::optional<InfoClass> class_named(std::string_view word) noexcept;

/// Of which robots.
struct Reach {
  enum class Kind : std::uint8_t { kNone, kOwn, kAll, kTeams } kind = Kind::kNone;
  std::set<std::string, std::less<>> teams;  ///< Of kTeams.

  [[nodiscard]] bool covers(std::string_view team, const Teams& own) const;
  /// Robots of every team, those to come included.
  [[nodiscard]] bool covers_all(const Teams& own) const;
  friend bool operator==(const Reach&, const Reach&) = default;
};

/// `none`, `own`, `all`, or for kTeams nothing.
[[nodiscard]] std::string_view to_string(Reach::Kind kind) noexcept;

/// A change of the table: of a role or of a user. Without a reach a role has again what the
/// scenario says, and a user what the role has.
struct RightChange {
  std::optional<Role> role{};  ///< Nothing: of `user`.
  std::string user{};
  InfoClass what = InfoClass::kPose;
  std::optional<Reach> reach{};
  friend bool operator==(const RightChange&, const RightChange&) = default;
};

/// The table. A super-user may everything, always: who could be locked out could not mend it.
class Rights {
 public:
  /// The usual rights.
  Rights();

  /// Error kInvalidArgument: of a super-user.
  [[nodiscard]] Status set(Role role, InfoClass what, Reach reach);
  /// Of one user, whatever the role; nothing: as the role again. Of a super-user it has no effect.
  void set_user(const std::string& user, InfoClass what, std::optional<Reach> reach);

  [[nodiscard]] const Reach& of(Role role, InfoClass what) const;
  [[nodiscard]] const Reach& of(const Person& person, InfoClass what) const;
  using Row = std::map<InfoClass, Reach>;
  /// Users with rights of their own.
  [[nodiscard]] const std::map<std::string, Row, std::less<>>& users() const noexcept {
    return users_;
  }

  /// The usual rights as a table of Markdown, for the documentation.
  [[nodiscard]] static std::string usual_table();

 private:
  std::array<std::array<Reach, kInfoClasses>, 3> roles_;
  std::map<std::string, Row, std::less<>> users_;
};

}  // namespace rave::gui_server
