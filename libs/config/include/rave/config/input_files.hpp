// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "rave/base/result.hpp"

namespace rave::config {

/// The content of files by absolute path, read once: all that is made of a scenario is made of the
/// same bytes, and a recording can bring its own. A value; copies share the contents, which never
/// change.
class InputFiles {
 public:
  using Content = std::shared_ptr<const std::string>;

  /// A second content of the same path is ignored.
  void add(const std::filesystem::path& path, Content content);
  /// The content of this path if it is here, else that of the file on the disk. Errors: those of
  /// rave::read_file().
  [[nodiscard]] Result<Content> read(const std::filesystem::path& path,
                                     std::size_t max_bytes) const;
  /// By absolute path without `.` and `..`.
  [[nodiscard]] const std::map<std::string, Content>& all() const noexcept { return all_; }

  bool operator==(const InputFiles& other) const;

 private:
  std::map<std::string, Content> all_;
};

}  // namespace rave::config
