// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/config/described.hpp"

namespace rave::config {

/// Keys of a scenario, as `--set` has them (see Settings), and their values.
using SettingValues = std::map<std::string, RawNode>;

/// A range of numbers.
struct FactorRangeFile {
  double low = 0;
  double high = 1;
  int steps = 5;  ///< Crossed and zipped: values at equal distances, both ends included.
  bool operator==(const FactorRangeFile&) const = default;
};

/// One value of a factor that changes several keys.
struct FactorLevelFile {
  Located<std::string> name;
  SettingValues set;  ///< Empty: the scenario as it is.
  bool operator==(const FactorLevelFile&) const = default;
};

/// What an experiment varies. Exactly one of `values`, `range` and `levels` is set; the first two
/// are values of `key`.
struct FactorFile {
  Located<std::string> name;
  std::optional<Located<std::string>> key;  ///< As in Settings.
  std::string unit;                         ///< Shown with the values; empty: none.
  std::vector<RawNode> values;
  std::optional<FactorRangeFile> range;
  std::vector<FactorLevelFile> levels;
  bool operator==(const FactorFile&) const = default;
};

/// How factors make conditions.
enum class ExperimentDesign : std::uint8_t {
  kCrossed,         ///< Every value with every value of the others; the last factor changes first.
  kZipped,          ///< First with first, second with second; all have the same number.
  kLatinHypercube,  ///< `samples` conditions; each factor has a range and one value of each part.
};

/// Which values of a metric are wished for.
enum class MetricAim : std::uint8_t { kNone, kLess, kMore };

/// A number of result.json.
struct MetricFile {
  Located<std::string> name;
  /// Its keys, separated by dots; items of lists by their `name`, by `robot` or counted from 0.
  Located<std::string> value;
  std::string unit;
  MetricAim better = MetricAim::kNone;
  /// The value of a run whose results have no such key; unset: that is an error.
  std::optional<double> absent;
  /// The value is the time of an event; null: it did not happen within the run (censored there).
  bool time_to_event = false;
  bool operator==(const MetricFile&) const = default;
};

/// What a comparison is expected to show: the first condition has less, more, or neither is shown.
enum class ComparisonOutcome : std::uint8_t { kLess, kMore, kNoDifference };

/// Two conditions, compared in one metric. Named before the runs, so that the number of comparisons
/// is known.
struct ComparisonFile {
  Located<std::string> metric;
  /// Values of factors, as they are written; a factor that is left out: all its values, one
  /// comparison each.
  std::map<std::string, RawNode> condition;
  std::map<std::string, RawNode> against;
  std::optional<ComparisonOutcome> expect;
  bool operator==(const ComparisonFile&) const = default;
};

/// Which runs keep their folder with the recording.
enum class KeepRecordings : std::uint8_t {
  kNone,
  kFailures,  ///< Of failed runs.
  kExtremes,  ///< Also of the best and the worst run of each condition, by the first metric.
  kAll,
};

/// What a run may take.
struct RunLimitsFile {
  double wall_s = 600;              ///< A run that takes longer is ended and counts as failed.
  std::optional<double> memory_mb;  ///< Address space of a run; unset: no limit.
  bool operator==(const RunLimitsFile&) const = default;
};

/// An experiment file as written, with defaults added.
struct ExperimentFile {
  Located<std::string> name;
  std::string question;
  Located<std::string> scenario;  ///< A file relative to this one.
  SettingValues set;              ///< For all runs.
  std::vector<FactorFile> factors;
  ExperimentDesign design = ExperimentDesign::kCrossed;
  int samples = 20;  ///< Latin hypercube: the number of conditions.
  int repetitions = 10;
  std::uint64_t first_seed = 1;  ///< All conditions have the same seeds, so that they are paired.
  std::vector<MetricFile> metrics;
  std::vector<ComparisonFile> comparisons;
  RunLimitsFile limits;
  KeepRecordings recordings = KeepRecordings::kNone;
  bool operator==(const ExperimentFile&) const = default;
};

/// Reads the text of an experiment file without opening the scenario. `file_name` is used in
/// messages. Errors: kParse with file:line:column.
[[nodiscard]] Result<ExperimentFile> read_experiment_text(std::string_view text,
                                                          std::string_view file_name);
/// The same of a file. Errors also: those of rave::read_file().
[[nodiscard]] Result<ExperimentFile> read_experiment_file(const std::filesystem::path& path);

/// The experiment as YAML; read_experiment_text() gives an equal value.
[[nodiscard]] std::string write_experiment(const ExperimentFile& experiment);

/// The JSON Schema (draft 07) of experiment files.
[[nodiscard]] std::string experiment_schema();

}  // namespace rave::config
