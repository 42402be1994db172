// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::control {

/// Where the sockets of running runs are: $XDG_RUNTIME_DIR/rave, else `rave-<uid>` in the system's
/// folder for temporary files. Created with mode 0700 if missing. Errors: kIo, kState (a link,
/// somebody else's, open to others).
[[nodiscard]] Result<std::filesystem::path> socket_folder();

/// Name of the run that this process does, such as `predator-prey-4711`; of the part of it that one
/// host of several does, `predator-prey@left-4711`.
[[nodiscard]] std::string own_run_name(std::string_view scenario, std::string_view host = {});

/// Names of the runs that go on, in order. Sockets of those that have died are removed.
[[nodiscard]] Result<std::vector<std::string>> running_runs();

/// The run that a word stands for: its name, its process id, or its scenario if only one run has
/// that; with an empty word the only run. Hosts of a run are named in full (`predator-prey@left`)
/// and count as runs only where there is nothing else. Errors: kNotFound with the nearest name or
/// the list.
[[nodiscard]] Result<std::string> find_run(std::string_view word);

/// For whoever has to choose: the names of these runs, of which there is at least one, and how to
/// say which, with a command line's `option` where that takes the run by one.
[[nodiscard]] std::string choose_one(std::span<const std::string_view> runs,
                                     std::string_view option = {});

}  // namespace rave::control
