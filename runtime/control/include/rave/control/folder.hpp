// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::control {

/// The folder with the control sockets of running runs: $XDG_RUNTIME_DIR/rave, else `rave-<uid>` in
/// the system's folder for temporary files. Created with mode 0700 if missing. Errors: kIo, kState
/// (a symbolic link, another owner, accessible to others).
[[nodiscard]] Result<std::filesystem::path> socket_folder();

/// Name of the run of this process, such as `predator-prey-4711`; for one of several hosts
/// `predator-prey@left-4711`.
[[nodiscard]] std::string own_run_name(std::string_view scenario, std::string_view host = {});

/// Names of the runs in progress, sorted. Removes sockets of processes that have died.
[[nodiscard]] Result<std::vector<std::string>> running_runs();

/// Finds a run by its name, its process id, or its scenario if only one run has that; an empty word
/// means the only run. Hosts of a run are named in full (`predator-prey@left`) and count as runs
/// only if there are no others. Errors: kNotFound with the nearest name or the list.
[[nodiscard]] Result<std::string> find_run(std::string_view word);

/// A message that lists these runs (at least one) and says how to select one, with the command-line
/// `option` for it if there is one.
[[nodiscard]] std::string choose_one(std::span<const std::string_view> runs,
                                     std::string_view option = {});

}  // namespace rave::control
