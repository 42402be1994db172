// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave {

/// The whole content of a file. Errors: kNotFound, kIo (a folder, no permission, larger than
/// `max_bytes`).
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::size_t max_bytes = std::size_t{1} << 30);

/// Replaces a file as a whole: writes beside it, flushes to disk and renames, so that a reader or
/// a crash sees the old content or the new one and never half of either.
[[nodiscard]] Status write_file_atomically(const std::filesystem::path& path,
                                           std::string_view content);

}  // namespace rave
