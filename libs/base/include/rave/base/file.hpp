// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave {

/// Reads a whole file. Errors: kNotFound, kIo (a folder, no permission, larger than `max_bytes`).
[[nodiscard]] Result<std::string> read_file(const std::filesystem::path& path,
                                            std::size_t max_bytes = std::size_t{1} << 30);

/// Replaces a file atomically: writes a temporary file beside it, flushes it to disk and renames
/// it. A reader, or a crash, finds either the old content or the new one, never a part. Error: kIo.
[[nodiscard]] Status write_file_atomically(const std::filesystem::path& path,
                                           std::string_view content);

/// The same of a file that only the user can read (mode 0600), as all that a run writes.
[[nodiscard]] Status write_private_file_atomically(const std::filesystem::path& path,
                                                   std::string_view content);

/// Creates a file that only the user can read (mode 0600), with its content on the disk. Never
/// replaces another. Errors: kNotFound (no such folder), kIo.
[[nodiscard]] Status write_private_file(const std::filesystem::path& path,
                                        std::string_view content);

/// Whether a file with a secret, such as a private key, is one. Error kState: all users can read or
/// change it, or it belongs to this user and its group can, unless the file is missing.
[[nodiscard]] Status check_private_file(const std::filesystem::path& path);

/// Creates a folder and those above it, where they are missing. Error: kIo.
[[nodiscard]] Status create_folder(const std::filesystem::path& folder);

}  // namespace rave
