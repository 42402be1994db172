// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "rave/base/result.hpp"

namespace rave::gui_server {

/// A small page in a file of the user alone, which leads to a link. A browser is started with the
/// name of the file: all users of a machine can read command lines, and the link is a secret.
/// Removed when it is destroyed.
class LinkFile {
 public:
  /// `name`: of the file; another one of that name is replaced. Error: kIo.
  [[nodiscard]] static Result<LinkFile> write(const std::filesystem::path& folder,
                                              const std::string& name, const std::string& link);
  LinkFile(LinkFile&& other) noexcept;
  LinkFile& operator=(LinkFile&& other) noexcept;
  LinkFile(const LinkFile&) = delete;
  LinkFile& operator=(const LinkFile&) = delete;
  ~LinkFile();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  explicit LinkFile(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;  ///< Empty: none.
};

}  // namespace rave::gui_server
