// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rave::cli {

/// `rave info`.
struct InfoCommand {
  std::string file;  ///< A record, or the folder of a run.
  bool json = false;
};

/// Prints what is in a record. Returns 0; 1 if the record is not whole; 2 if it is none.
[[nodiscard]] int info(const InfoCommand& options);

}  // namespace rave::cli
