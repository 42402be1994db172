// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "rave/base/result.hpp"

namespace rave::cli {

/// What there is to start and to show, as arrays of the message `conduct`. Reads files.
struct RunList {
  std::string scenarios = "[]";   ///< Names and descriptions, sorted.
  std::string recordings = "[]";  ///< Folders below `runs`, the newest first; at most 50.

  [[nodiscard]] static RunList read();
};

/// The folder of a run below `runs`, by its name alone. Error: kNotFound.
[[nodiscard]] Result<std::filesystem::path> folder_of_recording(const std::string& name);

}  // namespace rave::cli
