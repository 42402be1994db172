// SPDX-License-Identifier: Apache-2.0
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <thread>

#include "arguments.hpp"
#include "commands/version.hpp"
#include "error_text.hpp"
#include "rave/base/crash_note.hpp"

namespace rave::cli {
namespace {

struct Dispatch {
  int operator()(const Finished& finished) const { return finished.exit_code; }
  int operator()(const RunCommand& options) const { return run(options); }
  int operator()(const RobotCommand& options) const { return robot(options); }
  int operator()(const EnvCommand& options) const { return env(options); }
  int operator()(const CheckCommand& options) const { return check(options); }
  int operator()(const DriversCommand& options) const { return drivers(options); }
  int operator()(const DescribeCommand& options) const { return describe(options); }
  int operator()(const NewCommand& options) const { return new_project(options); }
  int operator()(const SchemaCommand& options) const { return schema(options); }
  int operator()(const InfoCommand& options) const { return info(options); }
  int operator()(const VerifyCommand& options) const { return verify(options); }
  int operator()(const PlayCommand& options) const { return play(options); }
  int operator()(const ExportCommand& options) const { return export_recording(options); }
  int operator()(const GapCommand& options) const { return report_gap(options); }
  int operator()(const GuiCommand& options) const { return gui(options); }
  int operator()(const PsCommand& options) const { return list_runs(options); }
  int operator()(const StopCommand& options) const { return stop_robots(options); }
  int operator()(const ArmCommand& options) const { return arm_robots(options); }
  int operator()(const SetCommand& options) const { return set_parameter(options); }
  int operator()(const HandOverCommand& options) const { return hand_over(options); }
  int operator()(const ShadowCommand& options) const { return show_shadows(options); }
  int operator()(const EditCommand& options) const { return edit_world(options); }
  int operator()(const OrderCommand& options) const { return give_order(options); }
  int operator()(const HoldCommand& options) const { return hold_run(options); }
  int operator()(const EndCommand& options) const { return end_run(options); }
  int operator()(const BenchSwarmCommand& options) const { return bench_swarm(options); }
  int operator()(const BenchCompareCommand& options) const { return bench_compare(options); }
  int operator()(const KeysNewCommand& options) const { return new_keys(options); }
  int operator()(const KeysAddCommand& options) const { return add_keys(options); }
  int operator()(const KeysShowCommand& options) const { return show_keys(options); }
  int operator()(const KeysLineCommand& options) const { return line_keys(options); }
  int operator()(const KeysWebCommand& options) const { return web_keys(options); }
  int operator()(const PeopleCommand& options) const { return people(options); }
  int operator()(const TopCommand& options) const { return top(options); }
  int operator()(const DoctorCommand& options) const { return doctor(options); }
  int operator()(const VersionCommand& /*options*/) const { return version(); }
};

/// The C library gives a thread that finds the heap locked a new one, up to eight for each core;
/// the memory of a process with many short waits then grows for hours and is never returned.
void limit_heaps() {
  const auto cores = static_cast<int>(std::thread::hardware_concurrency());
  mallopt(M_ARENA_MAX, std::max(cores, 1));
}

}  // namespace
}  // namespace rave::cli

int main(int argc, char** argv) {
  rave::install_crash_note();
  rave::cli::limit_heaps();
  try {
    return std::visit(rave::cli::Dispatch{}, rave::cli::parse_arguments(argc, argv));
  } catch (const std::exception& e) {
    // Out of memory, or a defect: say so rather than abort without a word.
    std::fprintf(stderr, "rave: unexpected failure: %s\n", e.what());
    return rave::cli::kNotGood;
  }
}
