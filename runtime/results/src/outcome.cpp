// SPDX-License-Identifier: Apache-2.0
#include "rave/results/outcome.hpp"

#include <algorithm>

#include "rave/base/disk_room.hpp"
#include "rave/base/file.hpp"
#include "rave/maps/map_save.hpp"
#include "rave/results/capture_watch.hpp"
#include "rave/results/event_log.hpp"
#include "rave/results/map_result.hpp"
#include "rave/results/sighting_check.hpp"
#include "stream_losses.hpp"

namespace rave::runtime {
namespace {

/// Events that mean the loss of a part of the run.
bool is_loss(sim::EventKind kind) {
  return kind == sim::EventKind::kProgramFailed || kind == sim::EventKind::kDriverFailed;
}

void fail_check(RunOutcome& outcome, bool made, std::string problem) {
  outcome.checks_hold = false;
  // A check that was not evaluated does not hold, but has not failed either; callers tell the two
  // apart.
  outcome.checks_fail = outcome.checks_fail || made;
  outcome.problems.push_back(std::move(problem));
}

void judge_capture(const RunResults& results, RunOutcome& outcome) {
  const auto& check = results.scenario.scenario.checks.capture;
  if (!check) return;
  const RunFacts& facts = results.facts;
  if (!facts.capture) {
    fail_check(outcome, false,
               "the capture check was not evaluated: no host saw all of the robots");
    return;
  }
  if (holds(*check, *facts.capture, facts.events, results.spec.step)) return;
  if (facts.world_from > 0) {
    fail_check(outcome, false,
               fmt::format("the capture check was not evaluated: captures before step {} are known "
                           "only to the previous manager",
                           facts.world_from));
    return;
  }
  if (results.ended_by_hand && results.done_s() < *check->before_s) {
    fail_check(outcome, false,
               fmt::format("the capture check was not evaluated: no robot was captured before the "
                           "run was ended by hand at {:.2f} s",
                           results.done_s()));
    return;
  }
  fail_check(
      outcome, true,
      fmt::format("the capture check fails: no robot was captured before {} s", *check->before_s));
}

void judge_sightings(const RunResults& results, RunOutcome& outcome) {
  const auto& limits = results.scenario.scenario.checks.sightings;
  if (!limits) return;
  const SightingTally tally = results.facts.sightings.value_or(SightingFacts()).all();
  // First: with results missing, the numbers below are too small for a judgement.
  if (results.any_lost()) {
    fail_check(outcome, false,
               "the sighting check was not evaluated: the results of a host are missing");
  } else if (tally.total < static_cast<std::uint64_t>(limits->min_compared)) {
    // With more time there might have been enough.
    const bool made = !results.ended_by_hand;
    fail_check(outcome, made,
               fmt::format("the sighting check {}: {} real sightings had a code that a body "
                           "carries, {} had none; expected at least {} to compare",
                           made ? "fails" : "was not evaluated", tally.total, tally.unknown,
                           limits->min_compared));
  } else if (!holds(*limits, tally)) {
    const std::uint64_t unknown = counted(*limits, tally) - tally.total;
    fail_check(
        outcome, true,
        fmt::format("the sighting check fails: {} of {} real sightings ({:.2f} %) agree with the "
                    "virtual camera within {} m and {} degrees; expected at least {} %{}",
                    tally.within, counted(*limits, tally), within_pct(*limits, tally),
                    limits->range_m, limits->bearing_deg, limits->min_within_pct,
                    unknown == 0
                        ? std::string()
                        : fmt::format("; {} of them have codes that no body carries", unknown)));
  }
}

void judge_checks(const RunResults& results, RunOutcome& outcome) {
  judge_capture(results, outcome);
  judge_sightings(results, outcome);
  for (const CheckResult& check : goal_results(results.scenario, results.spec, results.facts,
                                               results.lost, results.ended_by_hand)) {
    if (check.holds) continue;
    fail_check(outcome, check.made,
               fmt::format("a check {}: {}: {}", check.made ? "fails" : "was not evaluated",
                           check.name, check.text));
  }
}

}  // namespace

bool RunResults::any_lost() const noexcept {
  return std::any_of(lost.begin(), lost.end(), [](auto robot) { return robot != 0; });
}

double RunResults::done_s() const noexcept {
  return static_cast<double>(facts.steps) * spec.step.seconds();
}

double RunResults::time_s(const sim::Event& event) const noexcept {
  return static_cast<double>(event.step) * spec.step.seconds();
}

std::size_t RunResults::real_robots() const {
  return static_cast<std::size_t>(std::count_if(
      spec.robots.begin(), spec.robots.end(),
      [&](const sim::RobotSpec& robot) { return !spec.types[robot.type].simulated; }));
}

std::size_t RunResults::count(sim::EventKind kind) const {
  return static_cast<std::size_t>(
      std::count_if(facts.events.begin(), facts.events.end(),
                    [kind](const sim::Event& event) { return event.kind == kind; }));
}

GuardCounts guard_counts(const RunResults& results) {
  GuardCounts counts;
  for (const sim::Event& event : results.facts.events) {
    const bool slowed = event.kind == sim::EventKind::kGuardSlowed;
    if (!slowed && event.kind != sim::EventKind::kGuardStopped) continue;
    const std::string_view limit = to_string(static_cast<sim::GuardLimit>(event.detail));
    ++counts[results.spec.robots[event.robot.value()].name]
            [fmt::format("{} by {}", slowed ? "slowed" : "stopped", limit)];
  }
  return counts;
}

RunOutcome judge(const RunResults& results) {
  RunOutcome outcome;
  if (results.ended_by_hand) outcome.ended_by_hand_s = results.done_s();
  const RunFacts& facts = results.facts;
  outcome.problems.insert(outcome.problems.end(), facts.problems.begin(), facts.problems.end());
  const sim::EngineSpec& spec = results.spec;
  for (const sim::Event& event : facts.events) {
    // A program or driver that failed means that the robot did not do what the scenario asks, even
    // if all checks hold.
    if (!is_loss(event.kind)) continue;
    outcome.problems.push_back(fmt::format("robot `{}` at {:.2f} s: {}",
                                           spec.robots[event.robot.value()].name,
                                           results.time_s(event), event.text));
  }
  for (const RobotFacts& robot : facts.robots) {
    if (robot.known || facts.steps == 0) continue;
    outcome.problems.push_back(
        fmt::format("robot `{}` never reported its pose", spec.robots[robot.robot].name));
  }
  for (const sim::Event& event : facts.events) {
    if (event.kind != sim::EventKind::kChangeRefused) continue;
    outcome.problems.push_back(
        fmt::format("the change at {:.2f} s was refused: {}", results.time_s(event), event.text));
  }
  for (const sim::Event& event : facts.events) {
    // A refusal of a request by hand was reported to the person who made it.
    const bool scheduled = !sim::says_by_hand(event.text);
    if (event.kind != sim::EventKind::kHandOverRefused || !scheduled) continue;
    outcome.problems.push_back(fmt::format("robot `{}` at {:.2f} s was not handed over: {}",
                                           spec.robots[event.robot.value()].name,
                                           results.time_s(event), event.text));
  }
  // Fixed here: what follows are remarks and checks, which do not make a run incomplete.
  outcome.whole = outcome.problems.empty();
  // The run used all that its recordings contained, but the reader of the result should know of
  // gaps.
  for (std::string& loss : stream_losses(results)) outcome.problems.push_back(std::move(loss));
  judge_checks(results, outcome);
  if (results.hash) outcome.hash = fmt::format("{:016x}", *results.hash);
  return outcome;
}

std::string why_no_hash(const RunResults& results, const RunOutcome& outcome) {
  if (!outcome.hash.empty()) return {};
  if (!results.live_reason.empty()) return results.live_reason;
  return outcome.problems.empty() ? std::string("the results of some hosts are missing")
                                  : "the run did not complete: " + outcome.problems.front();
}

Descriptor take_room_for_results(const std::filesystem::path& folder, const sim::EngineSpec& spec) {
  // Some kilobytes of text, and a kilobyte for each robot, twice because files are replaced
  // atomically; the rest is for events.
  constexpr std::size_t kForEvents = std::size_t{1} << 20U;
  constexpr std::size_t kForRobot = std::size_t{2} << 10U;
  return take_disk_room(folder, kForEvents + kForRobot * spec.robots.size());
}

namespace {

/// The maps that programs kept, for `map_server` of ROS.
Status write_maps(const MapResults& maps, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return fail(ErrorCode::kIo, "{}", error.message());
  for (const auto& tiles : maps.tiles) {
    if (!tiles.empty()) RAVE_TRY(maps::save(tiles, folder / tiles.front().source));
  }
  return {};
}

}  // namespace

RunOutcome write_results(const RunResults& results, const std::filesystem::path& folder,
                         bool picture) {
  RunOutcome outcome = judge(results);
  bool all = true;
  const auto note = [&](const char* file, const Status& written) {
    if (written) return;
    all = outcome.whole = false;
    outcome.problems.push_back(
        fmt::format("`{}` is not written: {}", (folder / file).string(), written.error().message));
  };
  const auto write_summary = [&] {
    outcome.summary = summary_text(results, outcome);
    return write_private_file_atomically(folder / "summary.txt", outcome.summary);
  };
  const auto write_json = [&] {
    return write_private_file_atomically(folder / "result.json", result_json(results, outcome));
  };
  // On a disk with little room the small ones first: numbers cannot be had again from a picture.
  // A program that waits for `result.json` finds the other texts complete.
  note("summary.txt", write_summary());
  note("events.log",
       write_private_file_atomically(
           folder / "events.log", events_log(results.spec, results.kinds, results.facts.events)));
  note("result.json", write_json());
  if (const auto maps = map_results(results.spec, results.facts)) {
    note("maps", write_maps(*maps, folder / "maps"));
  }
  if (picture) {
    const report::Picture drawn = make_picture(results, outcome);
    note("picture.svg", report::write_svg(drawn, folder / "picture.svg"));
    note("picture.png", report::write_png(drawn, folder / "picture.png"));
  }
  if (all) return outcome;
  // Again, with what is missing. Where there is no room for that, either, the terminal has it.
  static_cast<void>(write_summary());
  static_cast<void>(write_json());
  return outcome;
}

}  // namespace rave::runtime
