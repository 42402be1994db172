// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>

#include "rave/base/result.hpp"

namespace rave::launch {

/// Where a run leaves everything, as the user asks for it.
struct WantedFolder {
  std::filesystem::path path;             ///< Empty: a new one below `runs`.
  bool replace = false;                   ///< What an earlier run left there is removed first.
  std::filesystem::path scenario_file{};  ///< Never overwritten or removed; empty: there is none.
};

/// The folder that a run leaves everything in. Unless given it is a new one,
/// `runs/<local time>-<scenario>`, with `-2`, `-3`, … behind if runs start in the same second.
/// The files of a run belong together, so those of two are never in one folder.
class RunFolder {
 public:
  /// Creates the folder. Errors: kInvalidArgument (it holds files of a run, and they are not to be
  /// replaced; it holds the scenario that is to run), kIo.
  [[nodiscard]] static Result<RunFolder> create(const WantedFolder& wanted,
                                                std::string_view scenario);

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  /// For a run that did not start: removes what it left, and the folder if that was not there
  /// before.
  void discard() const;

 private:
  std::filesystem::path path_;
  bool is_new_ = false;
};

}  // namespace rave::launch
