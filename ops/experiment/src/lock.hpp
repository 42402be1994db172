// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"

namespace rave::experiment {

/// Takes a file for this process until the descriptor is closed, also by the death of the process.
/// `shared`: others may share it. Errors: kState (another process has it), kIo.
[[nodiscard]] Result<Descriptor> lock_file(const std::filesystem::path& path, bool shared);

}  // namespace rave::experiment
