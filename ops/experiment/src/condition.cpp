// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/condition.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>

#include "rave/base/random.hpp"
#include "rave/config/settings.hpp"

namespace rave::experiment {
namespace {

using codec::RawNode;

/// One value of a factor.
struct Level {
  std::string name;
  config::SettingValues set;
};

void add(const config::SettingValues& set, Condition& condition) {
  for (const auto& [key, value] : set) {
    condition.settings.push_back(fmt::format("{}={}", key, codec::to_json_line(value)));
    condition.places.push_back(value.where());
  }
}

/// A number without the last digits, in which 0.1 + 0.2 is not 0.3.
RawNode rounded(double value, const SourceLocation& where) {
  RawNode node = RawNode::plain(fmt::format("{:.12g}", value));
  node.set_where(std::make_shared<const std::string>(where.file), where.line, where.column);
  return node;
}

Level level_of(const config::FactorFile& factor, const RawNode& value) {
  return {value.is_scalar() ? value.scalar() : codec::to_json_line(value), {{**factor.key, value}}};
}

std::vector<Level> levels_of(const config::FactorFile& factor) {
  std::vector<Level> levels;
  for (const RawNode& value : factor.values) levels.push_back(level_of(factor, value));
  for (const auto& level : factor.levels) levels.push_back({*level.name, level.set});
  if (!factor.range) return levels;
  const auto& range = *factor.range;
  for (int i = 0; i < range.steps; ++i) {
    const double value = range.low + (range.high - range.low) * i / (range.steps - 1);
    levels.push_back(level_of(factor, rounded(value, factor.key->where)));
  }
  return levels;
}

/// One value of each of `samples` equal parts of the range, in random order.
std::vector<Level> sampled_levels(const config::ExperimentFile& experiment, std::size_t index) {
  const config::FactorFile& factor = experiment.factors[index];
  const auto count = static_cast<std::size_t>(experiment.samples);
  RandomStream random(experiment.first_seed, static_cast<std::uint32_t>(index), 0, 0);
  std::vector<std::size_t> parts(count);
  std::iota(parts.begin(), parts.end(), 0);
  for (std::size_t i = count - 1; i > 0; --i) {
    const auto other = static_cast<std::size_t>(random.uniform(0, static_cast<double>(i + 1)));
    std::swap(parts[i], parts[std::min(other, i)]);
  }
  std::vector<Level> levels;
  for (const std::size_t part : parts) {
    const double share =
        (static_cast<double>(part) + random.uniform()) / static_cast<double>(count);
    const double value = factor.range->low + (factor.range->high - factor.range->low) * share;
    levels.push_back(level_of(factor, rounded(value, factor.key->where)));
  }
  return levels;
}

/// The level of each factor in condition `index`.
std::vector<std::size_t> choice_of(const std::vector<std::vector<Level>>& factors,
                                   config::ExperimentDesign design, std::size_t index) {
  std::vector<std::size_t> choice(factors.size(), index);
  if (design != config::ExperimentDesign::kCrossed) return choice;
  for (std::size_t f = factors.size(); f-- > 0;) {
    choice[f] = index % factors[f].size();
    index /= factors[f].size();
  }
  return choice;
}

}  // namespace

std::vector<Condition> conditions_of(const config::ExperimentFile& experiment) {
  const bool crossed = experiment.design == config::ExperimentDesign::kCrossed;
  std::vector<std::vector<Level>> factors;
  std::size_t count = 1;
  for (std::size_t f = 0; f < experiment.factors.size(); ++f) {
    factors.push_back(experiment.design == config::ExperimentDesign::kLatinHypercube
                          ? sampled_levels(experiment, f)
                          : levels_of(experiment.factors[f]));
    count = crossed ? count * factors.back().size() : factors.back().size();
  }
  std::vector<Condition> conditions(count);
  for (std::size_t c = 0; c < count; ++c) {
    add(experiment.set, conditions[c]);
    const auto choice = choice_of(factors, experiment.design, c);
    for (std::size_t f = 0; f < factors.size(); ++f) {
      conditions[c].levels.push_back(factors[f][choice[f]].name);
      add(factors[f][choice[f]].set, conditions[c]);
    }
  }
  return conditions;
}

std::string condition_text(const config::ExperimentFile& experiment, const Condition& condition) {
  std::string text;
  for (std::size_t f = 0; f < condition.levels.size(); ++f) {
    text += fmt::format("{}{}={}", text.empty() ? "" : ", ", *experiment.factors[f].name,
                        condition.levels[f]);
  }
  return text;
}

}  // namespace rave::experiment
