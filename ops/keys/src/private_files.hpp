// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/base/result.hpp"

// Files and folders that only the user can read, and that never replace others.
namespace rave::keys {

/// A temporary folder in which others are prepared, so that they appear complete. Its remaining
/// content is removed with it.
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

/// Moves a folder to its final name, if that is free. Errors: kInvalidArgument (the name is taken),
/// kIo.
[[nodiscard]] Status move_to_free_name(const std::filesystem::path& from,
                                       const std::filesystem::path& to);

/// Whether the name is taken, even by a dangling link.
[[nodiscard]] bool is_taken(const std::filesystem::path& path);

}  // namespace rave::keys
