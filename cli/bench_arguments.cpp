// SPDX-License-Identifier: Apache-2.0
#include <string>

#include "commands/bench.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

/// What a run of the swarm is, in both commands.
void add_workload(CLI::App& app, swarm::Workload& workload, swarm::RunEnd& end) {
  app.add_option_function<std::string>(
         "--workload",
         [&workload](const std::string& word) {
           workload.sensing = word == "B" ? swarm::Sensing::kB : swarm::Sensing::kA;
         },
         "A: 16 rays all around, 3 m; B: 180 rays ahead, 8 m [A]")
      ->type_name("A|B")
      ->check(one_of({"A", "B"}));
  add_value(app, "--robots", workload.robots, "Number of robots [1000]", "N")
      ->check(whole_number_in(1, swarm::kMostRobots));
  add_threads(app, workload.threads, "Number of threads; the result does not depend on it [1]");
  auto* const steps = add_value(app, "--steps", end.steps, "Number of steps of 0.1 s", "K")
                          ->check(whole_number_in(1, 1'000'000'000));
  add_value(app, "--seconds", end.seconds, "Wall time to measure [5]", "S")
      ->check(number_in(1e-3, 1e6))
      ->excludes(steps);
  app.add_option_function<std::string>(
         "--noise",
         [&workload](const std::string& word) {
           workload.noise = word == "gaussian" ? swarm::Noise::kGaussian : swarm::Noise::kNone;
         },
         "Noise of every range: none, or normal with 1 cm [none]")
      ->type_name("none|gaussian")
      ->check(one_of({"none", "gaussian"}));
  add_value(app, "--seed", workload.seed, "Random seed: start poses and noise [1]", "N")
      ->check(whole_number_in(0, UINT64_MAX));
}

void add_swarm(CLI::App& parent, Command& chosen) {
  const auto [app, c] =
      add_command(parent, chosen, "swarm",
                  "Measure the speed of robots that avoid boxes and each other", bench_swarm);
  add_workload(app, c.workload, c.end);
  add_value(app, "--write", c.write,
            "Also write the workload to this folder, as a scenario of the same length", "DIR");
  app.footer(
      "Prints one line of JSON. `rave run` of the written scenario gives the same run hash.\n\n"
      "Examples:\n"
      "  rave bench swarm --robots 10000\n"
      "  rave bench swarm --workload B --robots 1000 --steps 500 --write my/swarm\n"
      "  rave run my/swarm --no-record --no-picture");
}

void add_compare(CLI::App& parent, Command& chosen) {
  const auto [app, c] =
      add_command(parent, chosen, "compare",
                  "Compare the speed of two builds, measured alternately", bench_compare);
  add_word(app, "a", c.a, "Build folder or executable", "BUILD_A");
  add_word(app, "b", c.b, "Build folder or executable to compare with", "BUILD_B");
  add_workload(app, c.workload, c.end);
  add_value(app, "--rounds", c.rounds, "Runs of each build [7]", "N")
      ->check(whole_number_in(1, 1000));
  app.add_flag("--allow-different-hash", c.allow_different_hash,
               "Compare even if the run hashes differ");
  app.footer(
      "Prints one line of JSON, and one sentence to standard error. With --seconds, both builds "
      "do\n"
      "as many steps as A does in that time.\n\n"
      "Exit code: 0 if both were measured and their hashes agree (or may differ), 1 if not, 2 for\n"
      "bad input.\n\n"
      "Example:\n"
      "  rave bench compare ../before/build/release build/release --workload B --robots 1000");
}

}  // namespace

void add_bench_commands(CLI::App& root, Command& chosen) {
  CLI::App& parent = *root.add_subcommand("bench", "Measure the speed of this build");
  parent.require_subcommand(1);
  parent.footer("Example:\n  rave bench swarm --robots 10000");
  add_swarm(parent, chosen);
  add_compare(parent, chosen);
}

}  // namespace rave::cli
