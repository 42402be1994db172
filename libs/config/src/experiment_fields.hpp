// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "rave/config/experiment_file.hpp"

// The description of experiment files.
namespace rave::config {

constexpr auto enum_names(EnumTag<ExperimentDesign> /*tag*/) {
  return std::array{EnumName{ExperimentDesign::kCrossed, "crossed"},
                    EnumName{ExperimentDesign::kZipped, "zipped"},
                    EnumName{ExperimentDesign::kLatinHypercube, "latin_hypercube"}};
}

constexpr auto enum_names(EnumTag<MetricAim> /*tag*/) {
  return std::array{EnumName{MetricAim::kNone, "none"}, EnumName{MetricAim::kLess, "less"},
                    EnumName{MetricAim::kMore, "more"}};
}

constexpr auto enum_names(EnumTag<ComparisonOutcome> /*tag*/) {
  return std::array{EnumName{ComparisonOutcome::kLess, "less"},
                    EnumName{ComparisonOutcome::kMore, "more"},
                    EnumName{ComparisonOutcome::kNoDifference, "no_difference"}};
}

constexpr auto enum_names(EnumTag<KeepRecordings> /*tag*/) {
  return std::array{
      EnumName{KeepRecordings::kNone, "none"}, EnumName{KeepRecordings::kFailures, "failures"},
      EnumName{KeepRecordings::kExtremes, "extremes"}, EnumName{KeepRecordings::kAll, "all"}};
}

template <class V>
void describe(V& v, FactorRangeFile& c) {
  v.required("low", c.low, {.doc = "Lowest value."});
  v.required("high", c.high, {.doc = "Highest value."});
  v.field("steps", c.steps,
          {.doc = "Number of values at equal distances; not for latin_hypercube.",
           .min = 2,
           .max = 10000});
}

template <class V>
void describe(V& v, FactorLevelFile& c) {
  v.required("name", c.name, {.doc = "Name of the level.", .min_items = 1, .max_items = 100});
  v.field("set", c.set, {.doc = "Keys of the scenario and their values, as for `rave run --set`."});
}

template <class V>
void describe(V& v, FactorFile& c) {
  v.required("name", c.name, {.doc = "Name of the factor: letters, digits, - and _."});
  v.field("key", c.key, {.doc = "Key of the scenario, as for `rave run --set`."});
  v.field("unit", c.unit, {.doc = "Unit of the values, for tables and plots."});
  v.field("values", c.values, {.doc = "Values of the key.", .max_items = 10000});
  v.field("range", c.range, {.doc = "Instead of values: numbers of a range."});
  v.field("levels", c.levels,
          {.doc = "Instead of a key: named levels that set several keys.", .max_items = 10000});
}

template <class V>
void describe(V& v, MetricFile& c) {
  v.required("name", c.name, {.doc = "Name of the metric: letters, digits, - and _."});
  v.required("value", c.value,
             {.doc = "Keys of result.json that lead to the number, separated by dots; items of "
                     "lists by name or from 0."});
  v.field("unit", c.unit, {.doc = "Unit, for tables and plots."});
  v.field("better", c.better, {.doc = "Which values are wished for: none, less or more."});
  v.field("absent", c.absent,
          {.doc = "Value of a run whose results lack the key; unset: that is an error."});
  v.field("time_to_event", c.time_to_event,
          {.doc = "The value is the time of an event; null: not within the run."});
}

template <class V>
void describe(V& v, ComparisonFile& c) {
  v.required("metric", c.metric, {.doc = "Name of a metric."});
  v.required("condition", c.condition,
             {.doc = "Values of factors by name; without a factor: one comparison for each of its "
                     "values.",
              .min_items = 1});
  v.required("against", c.against, {.doc = "The other condition.", .min_items = 1});
  v.field("expect", c.expect,
          {.doc = "Expected result: the first has less, more, or no_difference is shown."});
}

template <class V>
void describe(V& v, RunLimitsFile& c) {
  v.field("wall_s", c.wall_s,
          {.doc = "Wall time after which a run is ended.",
           .min = 0,
           .exclusive_min = true,
           .max = 1e6,
           .unit = "s"});
  v.field("memory_mb", c.memory_mb,
          {.doc = "Address space of a run, in megabytes.", .min = 100, .max = 1e7});
}

template <class V>
void describe(V& v, ExperimentFile& c) {
  v.required("name", c.name, {.doc = "Name of the experiment: letters, digits, - and _."});
  v.field("question", c.question, {.doc = "What the experiment is to answer."});
  v.required("scenario", c.scenario, {.doc = "Scenario file, relative to this file."});
  v.field("set", c.set, {.doc = "Keys of the scenario and their values, in all runs."});
  v.required("factors", c.factors, {.doc = "What is varied.", .min_items = 1, .max_items = 100});
  v.field("design", c.design,
          {.doc = "How factors make conditions: crossed, zipped or latin_hypercube."});
  v.field("samples", c.samples,
          {.doc = "Number of conditions of latin_hypercube.", .min = 2, .max = 100000});
  v.field("repetitions", c.repetitions,
          {.doc = "Runs of each condition, with consecutive seeds.", .min = 1, .max = 100000});
  v.field("first_seed", c.first_seed, {.doc = "Seed of the first run of each condition."});
  v.required("metrics", c.metrics,
             {.doc = "What is measured; the first one ranks.", .min_items = 1, .max_items = 100});
  v.field("comparisons", c.comparisons,
          {.doc = "Comparisons named before the runs.", .max_items = 1000});
  v.field("limits", c.limits, {.doc = "What a run may take."});
  v.field("recordings", c.recordings,
          {.doc = "Which runs keep their recording: none, failures, extremes or all."});
}

void validate(const FactorRangeFile& c, CheckContext& check);
void validate(const FactorFile& c, CheckContext& check);
void validate(const MetricFile& c, CheckContext& check);
void validate(const ExperimentFile& c, CheckContext& check);

}  // namespace rave::config
