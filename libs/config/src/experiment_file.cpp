// SPDX-License-Identifier: Apache-2.0
#include "rave/config/experiment_file.hpp"

#include <algorithm>
#include <cmath>

#include "experiment_fields.hpp"
#include "file_checks.hpp"
#include "rave/base/names.hpp"
#include "rave/config/fields.hpp"

namespace rave::config {
namespace {

void check_latin_factor(const FactorFile& factor, CheckContext& check) {
  if (factor.range) return;
  check.error_at(factor.name.where,
                 "the factor `{}`: expected a `range`, of which design: latin_hypercube takes "
                 "numbers",
                 *factor.name);
}

std::size_t level_count(const FactorFile& factor) {
  if (factor.range) return static_cast<std::size_t>(factor.range->steps);
  return factor.levels.empty() ? factor.values.size() : factor.levels.size();
}

/// The largest experiment that the memory of a small machine holds.
constexpr double kMostRuns = 1e6;

void check_design(const ExperimentFile& c, CheckContext& check) {
  double conditions = c.design == ExperimentDesign::kLatinHypercube ? c.samples : 1;
  for (const FactorFile& factor : c.factors) {
    switch (c.design) {
      case ExperimentDesign::kLatinHypercube:
        check_latin_factor(factor, check);
        break;
      case ExperimentDesign::kZipped:
        conditions = static_cast<double>(level_count(factor));
        if (level_count(factor) == level_count(c.factors.front())) break;
        check.error_at(factor.name.where,
                       "the factor `{}` has {} values and `{}` has {}; expected the same number, "
                       "as design: zipped pairs them",
                       *factor.name, level_count(factor), *c.factors.front().name,
                       level_count(c.factors.front()));
        break;
      case ExperimentDesign::kCrossed:
        conditions *= static_cast<double>(level_count(factor));
        break;
    }
  }
  if (conditions * c.repetitions > kMostRuns) {
    check.error("repetitions", "{:.0f} conditions with {} runs each; expected at most {:.0f} runs",
                conditions, c.repetitions, kMostRuns);
  }
}

void check_side(const ExperimentFile& c, const std::map<std::string, RawNode>& side,
                const Located<std::string>& metric, CheckContext& check) {
  const auto factors = names_of(c.factors);
  for (const auto& [name, value] : side) {
    const auto factor = std::ranges::find(c.factors, name, [](const auto& f) { return *f.name; });
    if (factor == c.factors.end()) {
      check.error_at(value.where(), "there is no factor `{}`{}", name, suggestion(name, factors));
    } else if (factor->levels.empty() && !factor->range &&
               std::ranges::find(factor->values, value) == factor->values.end()) {
      check.error_at(value.where(), "the factor `{}` has no value {}", name,
                     codec::to_json_line(value));
    } else if (!factor->levels.empty()) {
      const auto levels = names_of(factor->levels);
      if (std::ranges::find(levels, value.scalar()) != levels.end()) continue;
      check.error_at(value.where(), "the factor `{}` has no level `{}`{}", name, value.scalar(),
                     suggestion(value.scalar(), levels));
    }
  }
  if (c.design != ExperimentDesign::kLatinHypercube) return;
  check.error_at(metric.where,
                 "a comparison needs conditions with chosen values; expected none "
                 "with design: latin_hypercube");
}

}  // namespace

void validate(const FactorRangeFile& c, CheckContext& check) {
  if (!std::isfinite(c.low) || !std::isfinite(c.high) || c.low >= c.high) {
    check.error("high", "expected more than `low`, {:g}; found {:g}", c.low, c.high);
  }
}

void validate(const FactorFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  const int given = (c.values.empty() ? 0 : 1) + (c.range ? 1 : 0) + (c.levels.empty() ? 0 : 1);
  if (given != 1) {
    check.error("name", "the factor `{}`: expected exactly one of `values`, `range` and `levels`",
                *c.name);
  } else if (c.levels.empty() != c.key.has_value()) {
    check.error("name", "the factor `{}`: {}", *c.name,
                c.key ? "expected no `key` with `levels`, which name theirs"
                      : "expected a `key` for its values");
  }
  check_unique("level", c.levels, check);
  for (std::size_t i = 0; i < c.values.size(); ++i) {
    if (std::find(c.values.begin(), c.values.begin() + static_cast<std::ptrdiff_t>(i),
                  c.values[i]) != c.values.begin() + static_cast<std::ptrdiff_t>(i)) {
      check.error_at(c.values[i].where(), "the factor `{}` has the value {} twice", *c.name,
                     codec::to_json_line(c.values[i]));
    }
  }
}

void validate(const MetricFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  if (c.value->empty())
    check.error("value", "expected keys of result.json, such as `events.contact`");
  if (c.absent && c.time_to_event) {
    check.error("absent",
                "expected no `absent` with `time_to_event`: null says that it did not "
                "happen");
  }
}

void validate(const ExperimentFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  check_unique("factor", c.factors, check);
  check_unique("metric", c.metrics, check);
  check_design(c, check);
  const auto metrics = names_of(c.metrics);
  for (const ComparisonFile& comparison : c.comparisons) {
    check_reference("metric", "metric", comparison.metric, metrics, check);
    check_side(c, comparison.condition, comparison.metric, check);
    check_side(c, comparison.against, comparison.metric, check);
  }
}

Result<ExperimentFile> read_experiment_text(std::string_view text, std::string_view file_name) {
  return read_text<ExperimentFile>(text, file_name);
}

Result<ExperimentFile> read_experiment_file(const std::filesystem::path& path) {
  return read_file<ExperimentFile>(path);
}

std::string write_experiment(const ExperimentFile& experiment) { return write_text(experiment); }

std::string experiment_schema() {
  return codec::json_schema(Codec<ExperimentFile>::schema({}), "RAVE experiment file",
                            "experiment.schema.json");
}

}  // namespace rave::config
