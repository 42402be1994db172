// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/bench.hpp"

namespace CLI {  // its own name. NOLINT(readability-identifier-naming)
class App;
}

namespace rave::cli {

/// Adds `bench swarm` and `bench compare`, which write what they are given to the two structs.
void add_bench(CLI::App& root, BenchSwarmCommand& swarm, BenchCompareCommand& compare);

}  // namespace rave::cli
