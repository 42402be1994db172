// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/base/result.hpp"

namespace rave {

/// Opens a file for reading and gives its descriptor, which the caller closes. Does not wait: a
/// named pipe that nobody writes to is refused like all that is not a regular file. Errors:
/// kNotFound, kIo (a folder, a pipe, a device, no permission).
[[nodiscard]] Result<int> open_regular_file(const std::filesystem::path& path);

}  // namespace rave
