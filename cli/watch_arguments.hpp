// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/doctor.hpp"
#include "commands/top.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

// Add `top` and `doctor`, which write what they are given to `c`.
void add_top(CLI::App& root, TopCommand& c);
void add_doctor(CLI::App& root, DoctorCommand& c);

}  // namespace rave::cli
