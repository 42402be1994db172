// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace rave::cli {

/// `rave info`.
struct InfoCommand {
  std::string file;    ///< A record, or the folder of a run.
  bool check = false;  ///< Every checksum is compared.
  bool json = false;
};

/// Prints what is in a record. Returns 0; 1 if something is wrong with it, or if it was to be
/// checked and a piece of it cannot be; 2 if it is none.
[[nodiscard]] int info(const InfoCommand& options);

}  // namespace rave::cli
