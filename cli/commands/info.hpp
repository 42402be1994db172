// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave info`.
struct InfoCommand {
  std::string file;    ///< A record, or the folder of a run.
  bool check = false;  ///< Every checksum is compared.
  bool json = false;
};

/// Prints the content of a recording. Returns 0; 1 if it is damaged, or was to be checked and a
/// part cannot be; 2 if it is not a recording.
[[nodiscard]] Result<int> info(const InfoCommand& options);

}  // namespace rave::cli
