// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "rave/base/result.hpp"
#include "rave/plugin/param_set.hpp"
#include "rave/sim/parameter_change.hpp"

namespace rave::sim {

/// Whether a value may stand for a parameter: type, range, choice. Errors: kInvalidArgument.
Status check_value(const ParamSpec& spec, const ParameterValue& value);

/// All values of a part with some changed. Errors: kNotFound with the nearest name;
/// kInvalidArgument.
[[nodiscard]] Result<plugin::ParamSet> with_changes(
    std::span<const ParamSpec> specs, std::span<const ParamValue> present,
    std::span<const ParameterChange* const> changes);

/// The value of one parameter as a person would write it.
[[nodiscard]] std::string value_text(const ParamSpec& spec, const ParamValue& value);

}  // namespace rave::sim
