// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "rave/config/described.hpp"

namespace rave::config {

/// `KEY=VALUE` for keys of a scenario, as command lines have them. KEY is a path of names separated
/// by dots: `robots.prey.pose.x_m`. Items of a list are named by their `name` or counted from 0.
/// VALUE is YAML.
using Settings = std::span<const std::string>;

/// Puts the values into the tree of a scenario before it is read, so that all its checks apply to
/// them. A key that is missing is added. Below `robot` and `twin_robot` of an entry are the keys of
/// its robot file, which is then read from `folder`. The place of a value in later errors is the
/// option: `--set duration_s=-1`. Errors: no KEY=VALUE, no YAML, an item that does not exist, a key
/// below a value that has none, a robot file that cannot be read.
void apply_settings(RawNode& scenario, Settings settings, const std::filesystem::path& folder,
                    Diagnostics& diagnostics);

}  // namespace rave::config
