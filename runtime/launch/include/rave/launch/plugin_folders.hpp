// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::launch {

/// A catalogue of the folders that are given, those of RAVE_PLUGIN_PATH (separated by colons) and
/// that of the installation of `program`, for the interfaces of this build; earlier folders win.
/// Errors: a folder that is missing or cannot be read.
[[nodiscard]] Result<std::unique_ptr<plugin::Catalogue>> open_catalogue(
    const std::vector<std::string>& given, const std::filesystem::path& program);

}  // namespace rave::launch
