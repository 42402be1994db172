// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::swarm {

/// How a program ended, and what it wrote to its standard output.
struct ChildEnd {
  int exit_code = 0;  ///< 128 and the number of the signal if one ended it.
  std::string output;
};

/// Runs a program to its end, with this process's environment but for the variables in `without`.
/// Its errors go where those of this process go. Errors: kIo.
[[nodiscard]] Result<ChildEnd> run_child(const std::filesystem::path& executable,
                                         const std::vector<std::string>& arguments,
                                         const std::vector<std::string>& without);

}  // namespace rave::swarm
