// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::cli {

/// The folder that a run leaves everything in. Unless given it is a new one,
/// `runs/<local time>-<scenario>`, with `-2`, `-3`, … behind if runs start in the same second.
class RunFolder {
 public:
  /// Creates the folder. Errors: kIo.
  [[nodiscard]] static Result<RunFolder> create(const std::filesystem::path& given,
                                                std::string_view scenario);

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// For a run that did not start: removes the folder again if it was not there before.
  void discard() const;

 private:
  std::filesystem::path path_;
  bool is_new_ = false;
};

}  // namespace rave::cli
