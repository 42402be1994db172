// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stop_token>
#include <string>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"

namespace rave::cli {

/// The run of several processes on the bus of `config` that a word stands for: as of
/// watch::choose_run(), or its scenario. Looks for it for `patience`. Errors: kNotFound, those of
/// bus::Bus::open().
[[nodiscard]] Result<bus::RunId> find_bus_run(const bus::BusConfig& config, const std::string& word,
                                              Duration patience, const std::stop_token& stop = {});

}  // namespace rave::cli
