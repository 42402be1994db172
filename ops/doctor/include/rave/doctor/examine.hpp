// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/bus/config.hpp"
#include "rave/doctor/finding.hpp"
#include "rave/doctor/machine.hpp"
#include "rave/doctor/probe.hpp"

namespace rave::doctor {

/// All checks of a machine, and probes of each peer of `config` on another machine. `config` need
/// not be valid. Takes some seconds if peers do not answer.
[[nodiscard]] Findings examine(const Machine& machine, const bus::BusConfig& config,
                               const About& here);

}  // namespace rave::doctor
