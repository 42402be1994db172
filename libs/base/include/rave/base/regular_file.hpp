// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/base/result.hpp"

namespace rave {

/// Opens a file for reading. The caller closes the returned descriptor. Only regular files are
/// accepted; a named pipe is refused without waiting for a writer. Errors: kNotFound, kIo (a
/// folder, a pipe, a device, no permission).
[[nodiscard]] Result<int> open_regular_file(const std::filesystem::path& path);

}  // namespace rave
