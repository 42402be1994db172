// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <stop_token>
#include <string>

#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/bus/config.hpp"

namespace rave::client {

/// The purpose of a search.
enum class SearchFor : std::uint8_t {
  kLook,  ///< To monitor: quick, with the runs that are found soon.
  kAct,   ///< To send a request: searches for the whole time, unless the full name or number is
          ///< given.
};

/// How long runs are searched for, here or on other machines.
[[nodiscard]] Duration search_patience(const bus::BusConfig& config);

/// The run on the bus of `config` that a word refers to: as of watch::choose_run(), or the only one
/// of that scenario. Searches for `patience`, then up to 1.5 s for the scenario of each run.
/// Errors: kNotFound (none, or several), those of bus::Bus::open().
[[nodiscard]] Result<bus::RunId> find_bus_run(const bus::BusConfig& config, const std::string& word,
                                              SearchFor what, Duration patience,
                                              const std::stop_token& stop = {});

}  // namespace rave::client
