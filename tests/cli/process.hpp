// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace rave::cli_test {

/// How a program ended that ran in tests/cli/data.
struct Ended {
  int exit_code = -1;  ///< -1: by a signal.
  std::string out;
  std::string err;
};

/// Runs `rave` with arguments, and with variables such as `NAME=value` in its environment.
[[nodiscard]] Ended run_rave(const std::vector<std::string>& arguments,
                             const std::vector<std::string>& variables = {});

/// Starts `rave` with its output dropped, or in a file; for tests that send signals.
[[nodiscard]] pid_t start_rave(const std::vector<std::string>& arguments,
                               const std::vector<std::string>& variables = {},
                               const std::string& out = "/dev/null");
/// Waits for it; -1 if a signal ended it.
[[nodiscard]] int wait_for(pid_t process);

/// A folder of its own that is removed again.
class TemporaryFolder {
 public:
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

[[nodiscard]] std::string content_of(const std::filesystem::path& file);

}  // namespace rave::cli_test
