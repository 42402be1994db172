// SPDX-License-Identifier: Apache-2.0
#include "commands/sweep.hpp"
#include "shared_arguments.hpp"

namespace rave::cli {
namespace {

void add_sweep(CLI::App& root, Command& chosen) {
  const auto [app, c] =
      add_command(root, chosen, "sweep", "Do the runs of an experiment that are missing", sweep);
  add_word(app, "experiment", c.experiment,
           "Experiment: a file, a folder with experiment.yaml, or a name", "EXPERIMENT");
  add_value(app, "--output", c.output, "Folder for the results [sweeps/NAME]", "DIR");
  add_value(app, "--jobs", c.jobs, "Runs at a time [number of cores]", "N")
      ->check(whole_number_in(1, 4096));
  add_value(app, "--shard", c.shard,
            "Only every N-th run, from the I-th on; shards may share a folder", "I/N");
  add_value(app, "--verify", c.verify,
            "Instead of missing runs, repeat N finished ones chosen at random and compare them",
            "N")
      ->check(whole_number_in(1, 1000000));
  app.add_flag("--retry", c.retry, "Also repeat runs that have failed");
  app.add_flag("--quiet", c.quiet, "Print errors and failures only");
  add_plugins(app, c.plugins);
  app.footer(
      "`rave check EXPERIMENT` prints the plan. Each run is a process. After Ctrl-C, or whatever\n"
      "else ends the sweep, the same command does the runs that are missing, or whose inputs have\n"
      "changed. The table runs.csv is the same, byte for byte, in whatever order and wherever the\n"
      "runs were done.\n"
      "Exit code: 0 if all runs are done and complete, 1 if not, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave sweep prey-speed\n"
      "  rave sweep my/experiment.yaml --shard 1/4 --output /shared/study");
}

}  // namespace

void add_experiment_commands(CLI::App& root, Command& chosen) { add_sweep(root, chosen); }

}  // namespace rave::cli
