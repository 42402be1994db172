// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "rave/base/descriptor.hpp"
#include "rave/base/result.hpp"

namespace rave::experiment {

/// A finished run.
struct RunRow {
  std::string inputs;  ///< Digest of all that decides the run but the seed: PlannedCondition.
  std::uint64_t seed = 0;
  /// Why the run has no values; empty: it is whole.
  std::string failure;
  std::vector<std::optional<double>> values;  ///< Of the metrics, in their order.
  double simulated_s = 0;
  std::string hash;   ///< The run hash; empty: none.
  double wall_s = 0;  ///< What it took.
  bool operator==(const RunRow&) const = default;
};

/// A row as one line of JSON, without a newline.
[[nodiscard]] std::string write_row(const RunRow& row);
/// Reads write_row(). Errors: kParse.
[[nodiscard]] Result<RunRow> read_row(std::string_view line);

/// The finished runs of an experiment by inputs and seed. A value.
class RunRows {
 public:
  /// Reads the lines of a ledger. Lines that are none are counted, as one that an end of the
  /// process cut off; their runs count as not done. Of two rows of one run the later one counts.
  void add(std::string_view text);
  void add(RunRow row);
  /// All ledgers of a folder, in the order of their names. Errors: those of rave::read_file().
  [[nodiscard]] static Result<RunRows> read(const std::filesystem::path& folder);

  /// Null: not finished. Valid until a row is added.
  [[nodiscard]] const RunRow* find(const std::string& inputs, std::uint64_t seed) const;
  [[nodiscard]] std::size_t size() const noexcept { return rows_.size(); }
  [[nodiscard]] std::size_t unreadable() const noexcept { return unreadable_; }

 private:
  std::map<std::pair<std::string, std::uint64_t>, RunRow> rows_;
  std::size_t unreadable_ = 0;
};

/// The file to which a sweep adds its rows. A row is written at once, so that the end of the
/// process loses none that append() has returned from. One thread at a time.
class Ledger {
 public:
  /// Opens or creates a file; a last line that was cut off is removed. Error: kIo.
  [[nodiscard]] static Result<Ledger> open(const std::filesystem::path& path);
  /// Errors: kIo, such as a full disk; the file then has the rows before.
  Status append(const RunRow& row);

 private:
  Ledger(std::filesystem::path path, Descriptor file)
      : path_(std::move(path)), file_(std::move(file)) {}

  std::filesystem::path path_;
  Descriptor file_;
};

}  // namespace rave::experiment
