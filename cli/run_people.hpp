// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "page.hpp"
#include "rave/base/result.hpp"
#include "rave/config/expanded_scenario.hpp"

namespace rave::cli {

/// The people of a run with a page. Their links are printed and kept nowhere. One thread.
class RunPeople {
 public:
  /// For the users of a scenario, if it has any: sees to it that `page` has accounts. On this
  /// machine alone they are those of the run and end with this object, which outlives the server.
  /// Errors: kIo.
  [[nodiscard]] static Result<std::unique_ptr<RunPeople>> of(
      const config::ExpandedScenario& scenario, PageOptions& page);
  /// The same for a page that stays while runs with users come and go; no person is invited yet.
  [[nodiscard]] static Result<std::unique_ptr<RunPeople>> of_page(PageOptions& page);
  RunPeople(const RunPeople&) = delete;
  RunPeople& operator=(const RunPeople&) = delete;
  ~RunPeople();

  /// Invites all of them and prints a link for each. Errors: those of gui_server::Accounts.
  [[nodiscard]] Status invite(gui_server::GuiServer& server) const;

 private:
  RunPeople() = default;
  [[nodiscard]] Status find_accounts(PageOptions& page);

  std::vector<config::PlannedPerson> people_;
  std::filesystem::path accounts_;
  std::filesystem::path temporary_;  ///< Empty, or removed at the end.
};

}  // namespace rave::cli
