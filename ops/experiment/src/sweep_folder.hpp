// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"
#include "rave/experiment/sweep.hpp"

namespace rave::experiment {

/// The folder of a sweep, taken for this process while this object lives.
class SweepFolder {
 public:
  /// Creates the folder and its files, and removes what an earlier process left in the work folder.
  /// Errors: those of sweep().
  [[nodiscard]] static Result<SweepFolder> open(const Plan& plan, const SweepOptions& options);

  [[nodiscard]] std::filesystem::path ledger() const {
    return path_ / ("ledger" + suffix_ + ".jsonl");
  }
  /// For the results of runs in progress.
  [[nodiscard]] std::filesystem::path work() const { return path_ / ("work" + suffix_); }

 private:
  SweepFolder(std::filesystem::path path, std::string suffix)
      : path_(std::move(path)), suffix_(std::move(suffix)) {}

  std::filesystem::path path_;
  std::string suffix_;  // of a shard
  Descriptor whole_;
  Descriptor own_;
};

}  // namespace rave::experiment
