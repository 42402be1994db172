// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave keys new`.
struct KeysNewCommand {
  std::string folder;
  std::string lab = "rave";
  int days = 3650;
  std::vector<std::string> members;
};

/// `rave keys add`.
struct KeysAddCommand {
  std::string folder;
  int days = 0;  ///< 0: as long as the authority.
  std::vector<std::string> members;
};

/// `rave keys show`.
struct KeysShowCommand {
  std::string folder;
};

/// `rave keys web`.
struct KeysWebCommand {
  std::string folder;
  int days = 397;
  std::vector<std::string> names;
};

/// `rave keys line`.
struct KeysLineCommand {
  std::string file;
};

// Each prints what was done, and never a private key. Returns 0; 2 for bad input; `keys show` 1 if
// something cannot be used.
[[nodiscard]] Result<int> new_keys(const KeysNewCommand& options);
[[nodiscard]] Result<int> add_keys(const KeysAddCommand& options);
[[nodiscard]] Result<int> show_keys(const KeysShowCommand& options);
[[nodiscard]] Result<int> web_keys(const KeysWebCommand& options);
[[nodiscard]] Result<int> line_keys(const KeysLineCommand& options);

}  // namespace rave::cli
