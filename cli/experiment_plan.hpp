// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "rave/base/result.hpp"
#include "rave/experiment/plan.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::cli {

/// Reads and checks an experiment; see experiment::make_plan(). `measure_s`: as its option.
[[nodiscard]] Result<experiment::Plan> load_plan(const std::filesystem::path& file,
                                                 plugin::Catalogue& catalogue, double measure_s);

/// Checks an experiment and prints its plan: conditions, runs, expected time. Errors: those of
/// load_plan().
[[nodiscard]] Status check_experiment(const std::filesystem::path& file,
                                      plugin::Catalogue& catalogue);

/// The number of processors that this process may use.
[[nodiscard]] std::size_t usable_cores();

/// A span of wall time for people, such as `3 min 20 s`.
[[nodiscard]] std::string wall_time_text(double seconds);

}  // namespace rave::cli
