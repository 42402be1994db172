// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "rave/base/result.hpp"

// Files and folders that nobody but the user can read, and that replace nothing.
namespace rave::keys {

/// A folder to prepare others in, so that these appear whole. What is left in it goes with it.
class ScratchFolder {
 public:
  /// Inside `parent`, because moving to another file system would be copying. Errors: kNotFound
  /// (no such parent), kIo.
  [[nodiscard]] static Result<ScratchFolder> inside(const std::filesystem::path& parent);
  ScratchFolder(ScratchFolder&& other) noexcept;
  ScratchFolder& operator=(ScratchFolder&&) = delete;
  ~ScratchFolder();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}

  std::filesystem::path path_;  // empty: moved from
};

/// Makes a folder with mode 0700. Errors: kIo.
[[nodiscard]] Status make_private_folder(const std::filesystem::path& folder);

/// Writes a file that was not there, with mode 0600, to the disk. Errors: kIo.
[[nodiscard]] Status write_private_file(const std::filesystem::path& file,
                                        std::string_view content);

/// Gives a folder its final name, unless something has that already. Errors: kInvalidArgument (it
/// is there), kIo.
[[nodiscard]] Status move_to_free_name(const std::filesystem::path& from,
                                       const std::filesystem::path& to);

/// Whether something, even a dead link, has that name.
[[nodiscard]] bool is_taken(const std::filesystem::path& path);

}  // namespace rave::keys
