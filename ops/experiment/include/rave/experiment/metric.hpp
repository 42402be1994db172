// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string_view>

#include "rave/base/result.hpp"
#include "rave/codec/raw_node.hpp"
#include "rave/config/experiment_file.hpp"

namespace rave::experiment {

/// The number that a path of keys leads to in a result.json. Items of lists are found by their
/// `name` or `robot`, or counted from 0. Empty: null, which is unknown or did not happen. Errors:
/// kNotFound (no such key, with the nearest one), kInvalidArgument (no number).
[[nodiscard]] Result<std::optional<double>> number_at(const codec::RawNode& result,
                                                      std::string_view path);

/// The value of a metric of a run; number_at(), and `absent` where there is no such key.
[[nodiscard]] Result<std::optional<double>> value_of(const config::MetricFile& metric,
                                                     const codec::RawNode& result);

}  // namespace rave::experiment
