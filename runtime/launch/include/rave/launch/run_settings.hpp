// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/bus/bus_options.hpp"
#include "rave/launch/host_line.hpp"

namespace rave::launch {

/// The settings that all processes of a run have in common. What is unset comes from the scenario.
struct RunSettings {
  /// The program `rave` of this installation: hosts are started with it, and the plug-ins of the
  /// installation are found from it.
  std::filesystem::path program;
  std::string scenario;  ///< A file, a folder or a name; for the commands that the log shows.
  std::optional<std::uint64_t> seed{};
  std::optional<double> duration_s{};
  std::optional<int> processes{};  ///< Divide the robots among this number of processes.
  std::vector<std::string> set{};  ///< KEY=VALUE; see config::Settings.
  std::vector<std::string> plugins{};
  bool no_picture = false;
  bool no_record = false;
  bool arm = false;
  bus::BusOptions bus{};  ///< For runs with several processes.
  LineArguments line{};   ///< Of the hosts that this process runs or starts.
};

}  // namespace rave::launch
