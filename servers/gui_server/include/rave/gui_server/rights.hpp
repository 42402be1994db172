// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/base/word_table.hpp"
#include "rave/config/gui_file.hpp"
#include "rave/gui_server/person.hpp"

// Rights: which data a user may see and which requests a user may send. One table, which the
// documentation prints. Plain values, no threads.
namespace rave::gui_server {

/// The classes that rights refer to.
using InfoClass = config::GuiClass;
inline constexpr std::size_t kInfoClasses = config::kGuiClasses;

[[nodiscard]] std::string_view to_string(InfoClass what) noexcept;
[[nodiscard]] std::optional<InfoClass> class_named(std::string_view word) noexcept;

/// The robots that a right covers.
struct Reach {
  using Kind = config::GuiReach;
  Kind kind = Kind::kNone;
  std::set<std::string, std::less<>> teams;  ///< Used with kTeams.

  [[nodiscard]] bool covers(std::string_view team, const Teams& own) const;
  /// Whether it covers robots of every team, future ones included.
  [[nodiscard]] bool covers_all(const Teams& own) const;
  friend bool operator==(const Reach&, const Reach&) = default;
};

/// The words of reaches; kTeams has none.
inline constexpr WordTable<Reach::Kind, 3> kReaches = {
    {{"none", Reach::Kind::kNone}, {"own", Reach::Kind::kOwn}, {"all", Reach::Kind::kAll}}};

/// A change of the table for a role or a user. Without a reach, a role returns to the scenario's
/// rights, and a user to those of the role.
struct RightChange {
  std::optional<Role> role{};  ///< Empty: the change is for `user`.
  std::string user{};
  InfoClass what = InfoClass::kPose;
  std::optional<Reach> reach{};
  friend bool operator==(const RightChange&, const RightChange&) = default;
};

/// The table of rights. A super-user always has all rights; otherwise a locked-out one could not
/// correct the table.
class Rights {
 public:
  /// The default rights.
  Rights();

  /// Sets a right of a role. Error kInvalidArgument: super-user.
  [[nodiscard]] Status set(Role role, InfoClass what, Reach reach);
  /// Sets a right of one user, independent of the role; empty `reach`: that of the role again. No
  /// effect for a super-user, nor for a person who chose the name (Person::name_given).
  void set_user(const std::string& user, InfoClass what, std::optional<Reach> reach);

  [[nodiscard]] const Reach& of(Role role, InfoClass what) const;
  [[nodiscard]] const Reach& of(const Person& person, InfoClass what) const;
  using Row = std::map<InfoClass, Reach>;
  /// Users with individual rights.
  [[nodiscard]] const std::map<std::string, Row, std::less<>>& users() const noexcept {
    return users_;
  }

  /// The default rights as a Markdown table, for the documentation.
  [[nodiscard]] static std::string usual_table();

 private:
  std::array<std::array<Reach, kInfoClasses>, 3> roles_;
  std::map<std::string, Row, std::less<>> users_;
};

}  // namespace rave::gui_server
