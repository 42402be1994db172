// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"

namespace rave::cli {

/// What a run is looked for.
enum class SearchFor : std::uint8_t {
  kLook,  ///< To look on: quick, with those that are found soon.
  kAct,   ///< To ask something of it: the whole patience, unless its name or whole number is said.
};

/// The run of several processes on the bus of `config` that a word stands for: as of
/// watch::choose_run(), or its scenario, if one alone is of it. Looks for it for `patience`; the
/// scenario of each run is looked for after that, for up to 1.5 s. Errors: kNotFound (none, or
/// several), those of bus::Bus::open().
[[nodiscard]] Result<bus::RunId> find_bus_run(const bus::BusConfig& config, const std::string& word,
                                              SearchFor what, Duration patience,
                                              const std::stop_token& stop = {});

}  // namespace rave::cli
