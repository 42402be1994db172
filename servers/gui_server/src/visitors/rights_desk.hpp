// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "rave/gui_server/rights.hpp"
#include "visitors/view.hpp"

namespace rave::gui_server {

/// A change of a run, as it is kept in a file.
struct KeptChange {
  std::string run;
  RightChange change;
};

/// Strict: error kParse at the line of whatever it does not know.
[[nodiscard]] Result<std::vector<KeptChange>> parse_rights(std::string_view text,
                                                           std::string_view file_name);
[[nodiscard]] std::string write_rights(const std::vector<KeptChange>& changes);

/// The rights in force: the usual ones, those of the scenario, and what super-users change while a
/// run goes, which outlives the server. One thread.
class RightsDesk {
 public:
  /// `folder`: where changes are kept, in the file `rights`; empty: nowhere. Errors: kIo, kParse.
  [[nodiscard]] static Result<RightsDesk> open(std::filesystem::path folder);

  /// Begins with another run. `scenario`: its rights.
  void begin(const std::string& run, const Rights& scenario, std::shared_ptr<const Cast> cast);
  /// In force from the next view on. Errors: kInvalidArgument (of a super-user) and kParse (names),
  /// and then nothing changes; kIo: it is in force but will not outlive the server.
  [[nodiscard]] Status change(const RightChange& change);

  /// People with equal rights share a view.
  [[nodiscard]] std::shared_ptr<const View> view_of(const Person& person);
  /// Another number whenever views may be others.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  [[nodiscard]] const Cast& cast() const noexcept { return *cast_; }
  [[nodiscard]] const Rights& rights() const noexcept { return rights_; }
  /// The users that rights mention, of this run and of others for which changes are kept.
  [[nodiscard]] std::set<std::string, std::less<>> mentioned() const;
  /// The message `rights`.
  [[nodiscard]] std::string message(const std::vector<Person>& people) const;

 private:
  void renew();
  void apply(const RightChange& change);

  std::filesystem::path folder_;
  std::vector<KeptChange> kept_;
  std::string run_;
  Rights scenario_;
  Rights rights_;
  std::shared_ptr<const Cast> cast_ = std::make_shared<const Cast>();  ///< Shared with the views.
  std::map<std::string, std::weak_ptr<const View>> views_;             ///< By key.
  std::uint64_t revision_ = 0;
};

}  // namespace rave::gui_server
