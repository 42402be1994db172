// SPDX-License-Identifier: Apache-2.0
#include "commands/branch.hpp"
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
  auto* const slurm =
      add_value(app, "--slurm", c.slurm,
                "Do the runs as a job array of Slurm with N tasks, and wait for it", "N")
          ->check(whole_number_in(1, 100000));
  add_values(app, "--slurm-option", c.slurm_options,
             "Word for `sbatch`, such as --partition=short; repeatable", "WORD")
      ->needs(slurm);
  app.get_option("--shard")->excludes(slurm);
  app.add_flag("--retry", c.retry, "Also repeat runs that have failed")->excludes(slurm);
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

void add_branch(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(
      root, chosen, "branch",
      "Repeat a recorded run up to a time and continue it with something different", branch);
  add_record(app, c.file);
  add_value(app, "--at", c.at_s, "Time of the recorded run at which the branch begins, in seconds",
            "S")
      ->required()
      ->check(number_in(0, 1e9));
  add_values(app, "--set", c.set,
             "Value for a parameter of a robot from there on, as for `rave set`; repeatable",
             "ROBOT.KEY=VALUE");
  add_values(app, "--edit", c.edit,
             "Edit of the obstacles there, as in `changes` of a scenario; repeatable", "JSON");
  app.add_flag("--with-people", c.with_people,
               "Also repeat what people asked in the recorded run after that time");
  add_value(app, "--until", c.until_s, "End of the branch, in seconds [end of the scenario]", "S")
      ->check(number_in(1e-4, 1e9));
  add_value(app, "--output", c.output, "Folder for the results [runs/<time>-branch]", "DIR");
  app.add_flag("--replace", c.replace, "Remove the results of an earlier run from that folder");
  app.add_flag("--no-picture", c.no_picture, "Do not draw picture.svg and picture.png");
  app.add_flag("--quiet", c.quiet, "Print errors and problems only");
  add_plugins(app, c.plugins);
  app.footer(
      "The steps before the branch are computed again, with what people asked in them, and their\n"
      "hashes are compared with the recording. The recording of the branch names its parent in "
      "the\n"
      "description of its scenario. `rave diff` compares both.\n"
      "Exit code: 0 if the branch completed and its checks hold, 1 if not or if the repetition\n"
      "differs, 2 for bad input.\n\n"
      "Examples:\n"
      "  rave branch runs/20260101-120000-predator-prey --at 30 --set "
      "prey.program.max_speed_mps=0.1\n"
      "  rave branch run.mcap --at 5 --edit '{\"remove_obstacle\": \"crate\"}'");
}

void add_diff(CLI::App& root, Command& chosen) {
  const auto [app, c] = add_command(
      root, chosen, "diff", "Tell where two recorded runs part, and how far apart they are", diff);
  add_word(app, "first", c.first, "Recording (run.mcap), or folder of a run", "FIRST");
  add_word(app, "second", c.second, "The other one", "SECOND");
  app.add_flag("--quiet", c.quiet, "Print errors only");
  app.footer(
      "Exit code: 0 if all that both runs have is equal to the bit, 1 if not, 2 for bad input.\n\n"
      "Example:\n"
      "  rave diff runs/20260101-120000-predator-prey runs/20260101-120500-branch");
}

}  // namespace

void add_experiment_commands(CLI::App& root, Command& chosen) {
  add_sweep(root, chosen);
  add_branch(root, chosen);
  add_diff(root, chosen);
}

}  // namespace rave::cli
