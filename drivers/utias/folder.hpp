// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "utias/load_options.hpp"
#include "utias/recording_names.hpp"
#include "utias/text_log.hpp"

namespace rave::utias {

/// One parsed log file; stamps are still absolute.
struct LogFile {
  std::string path;  ///< As shown in messages.
  recording::LogIdentity identity;
  ParsedLog log;
};

/// The folder of a data set. Keeps no file open.
class Folder {
 public:
  /// Reads `stretch.txt` if it exists. Errors: kNotFound (no such folder); those of parse_stretch.
  [[nodiscard]] static Result<Folder> open(const std::filesystem::path& path);

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }
  [[nodiscard]] const std::optional<Stretch>& stretch() const noexcept { return stretch_; }
  /// The numbers of the robots with at least one log, ascending.
  [[nodiscard]] const std::vector<int>& robots() const noexcept { return robots_; }

  /// Reads `<stem>.dat.gz` or, if that does not exist, `<stem>.dat`. Errors: kNotFound (names the
  /// file), those of unpack_text and parse_log, and kParse for a file that differs from its digest.
  [[nodiscard]] Result<LogFile> read(std::string_view stem, std::span<const Column> columns,
                                     bool accept_cut) const;

 private:
  Status find_robots();

  std::filesystem::path path_;
  std::optional<Stretch> stretch_;
  std::vector<int> robots_;
};

}  // namespace rave::utias
