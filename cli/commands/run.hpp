// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bus_options.hpp"
#include "host_line.hpp"
#include "page.hpp"
#include "rave/base/result.hpp"

namespace rave::cli {

/// `rave run`. What is unset comes from the scenario.
struct RunCommand {
  std::string scenario;  ///< A file, a folder or a name.
  std::string output;    ///< Empty: runs/<time>-<scenario>.
  bool replace = false;  ///< Remove the results of an earlier run there.
  std::optional<std::uint64_t> seed;
  std::optional<int> threads;
  std::optional<double> duration_s;
  std::optional<std::string> pace;
  bool no_picture = false;
  bool no_record = false;
  bool arm = false;
  bool paused = false;  ///< Wait before the first step until a person resumes it.
  bool quiet = false;
  std::vector<std::string> plugins;
  std::optional<int> processes;  ///< Divide the robots among this number of processes.
  BusOptions bus;                ///< For runs with several processes.
  bool gui = false;              ///< Show it in the browser, then its recording.
  PageOptions page;
  LineArguments line;  ///< Of the hosts that this process runs or starts.
};

/// Runs a scenario. Returns 0 if it completed and its checks hold, 1 if not, 2 on bad input.
[[nodiscard]] Result<int> run(const RunCommand& options);

}  // namespace rave::cli
