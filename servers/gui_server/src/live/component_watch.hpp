// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "run/components.hpp"

namespace rave::gui_server {

/// Reads the panels of a scenario again after a change of the files that list them, so that an
/// author sees a new one without another run. One thread.
class ComponentWatch {
 public:
  /// `scenario`: the file; empty: there is none, and nothing changes.
  explicit ComponentWatch(std::filesystem::path scenario);

  /// The panels, if a file has changed since the last call or the construction; nothing: they are
  /// as before. An error is returned once; until the files are right again nothing is returned.
  /// Errors: those of config::read_gui_of() and components_of().
  [[nodiscard]] std::optional<Result<std::vector<PageComponent>>> look();

 private:
  [[nodiscard]] std::string stamp() const;

  std::filesystem::path scenario_;
  std::vector<std::filesystem::path> files_;
  std::string stamp_;  ///< Times and sizes of the files.
  std::string told_;   ///< The error that was returned; empty: all is well.
};

}  // namespace rave::gui_server
