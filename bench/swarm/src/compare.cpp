// SPDX-License-Identifier: Apache-2.0
#include "rave/swarm/compare.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "child_process.hpp"

namespace rave::swarm {
namespace {

namespace fs = std::filesystem;

bool is_executable(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error) && ::access(path.c_str(), X_OK) == 0;
}

std::vector<std::string> arguments_of(const Workload& workload, const RunEnd& end) {
  std::vector<std::string> words = {"bench",      "swarm",
                                    "--workload", std::string(to_string(workload.sensing)),
                                    "--robots",   fmt::format("{}", workload.robots),
                                    "--threads",  fmt::format("{}", workload.threads),
                                    "--noise",    std::string(to_string(workload.noise)),
                                    "--seed",     fmt::format("{}", workload.seed)};
  words.emplace_back(end.steps ? "--steps" : "--seconds");
  words.push_back(end.steps ? fmt::format("{}", *end.steps) : fmt::format("{}", *end.seconds));
  return words;
}

/// What is used of the line that a run prints.
struct RunLine {
  std::uint64_t steps = 0;
  double robot_steps_per_s = 0;
  std::string hash;
};

Result<RunLine> run_once(const fs::path& executable, const Workload& workload, const RunEnd& end) {
  const std::vector<std::string> words = arguments_of(workload, end);
  // With these, one build would run what belongs to the other.
  RAVE_TRY_ASSIGN(const ChildEnd child,
                  run_child(executable, words, {"RAVE_PLUGIN_PATH", "RAVE_SHARE"}));
  if (child.exit_code != 0) {
    return fail(ErrorCode::kState, "`{} {}` ended with exit code {}; expected 0",
                executable.string(), fmt::join(words, " "), child.exit_code);
  }
  const auto json = nlohmann::json::parse(child.output, nullptr, false);
  RunLine line;
  if (json.is_object()) {
    const auto steps = json.find("steps");
    const auto rate = json.find("robot_steps_per_s");
    const auto hash = json.find("hash");
    if (steps != json.end() && steps->is_number_unsigned()) line.steps = *steps;
    if (rate != json.end() && rate->is_number()) line.robot_steps_per_s = *rate;
    if (hash != json.end() && hash->is_string()) line.hash = *hash;
  }
  if (line.steps > 0 && line.robot_steps_per_s > 0 && !line.hash.empty()) return line;
  return fail(ErrorCode::kState,
              "`{} {}` printed `{}`; expected JSON with `steps`, `robot_steps_per_s` and `hash`",
              executable.string(), fmt::join(words, " "), child.output.substr(0, 200));
}

/// Runs one build once more, which must give the hash that it gave before.
Status run_again(ComparedBuild& build, const Workload& workload, const RunEnd& end) {
  RAVE_TRY_ASSIGN(const RunLine line, run_once(build.executable, workload, end));
  if (!build.hash.empty() && line.hash != build.hash) {
    return fail(ErrorCode::kState,
                "`{}` gave the hashes {} and {} for the same run; expected the same each time",
                build.executable.string(), build.hash, line.hash);
  }
  build.hash = line.hash;
  build.robot_steps_per_s.push_back(line.robot_steps_per_s);
  return {};
}

Status check(const CompareOptions& options, const Comparison& comparison) {
  if (comparison.same_hash() || options.allow_different_hash) return {};
  return fail(ErrorCode::kState,
              "the builds do not do the same: after {} steps `{}` has the hash {} and `{}` has {}; "
              "--allow-different-hash compares them all the same",
              comparison.steps, comparison.a.executable.string(), comparison.a.hash,
              comparison.b.executable.string(), comparison.b.hash);
}

/// The value at a share of the way through sorted values.
double at_share(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(std::floor(at));
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (at - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

nlohmann::ordered_json json_of(const Spread& spread) {
  return {{"median", spread.median}, {"p10", spread.p10}, {"p90", spread.p90}};
}

nlohmann::ordered_json json_of(const ComparedBuild& build) {
  return {{"rave", build.executable.string()},
          {"hash", build.hash},
          {"robot_steps_per_s", json_of(spread_of(build.robot_steps_per_s))}};
}

}  // namespace

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  return {at_share(values, 0.5), at_share(values, 0.1), at_share(values, 0.9)};
}

Result<fs::path> find_rave(const fs::path& build) {
  std::error_code error;
  if (!fs::is_directory(build, error)) {
    if (is_executable(build)) return fs::absolute(build, error);
    return fail(ErrorCode::kNotFound,
                "there is no build `{}`: expected a folder with `bin/rave`, or an executable file",
                build.string());
  }
  for (const fs::path& path : {build / "bin" / "rave", build / "rave"}) {
    if (is_executable(path)) return fs::absolute(path, error);
  }
  return fail(ErrorCode::kNotFound, "there is no executable `{}` and no `{}`",
              (build / "bin" / "rave").string(), (build / "rave").string());
}

Result<Comparison> compare(const CompareOptions& options) {
  Comparison comparison;
  comparison.workload = options.workload;
  RAVE_TRY_ASSIGN(comparison.a.executable, find_rave(options.a));
  RAVE_TRY_ASSIGN(comparison.b.executable, find_rave(options.b));
  RunEnd end = options.end;
  if (!end.steps) {
    RAVE_TRY_ASSIGN(const RunLine line,
                    run_once(comparison.a.executable, options.workload, options.end));
    end = {line.steps, std::nullopt};
  }
  comparison.steps = *end.steps;
  std::vector<double> ratios;
  for (int round = 0; round < options.rounds; ++round) {
    // What goes first finds the machine in another state than what follows.
    std::array<ComparedBuild*, 2> order = {&comparison.a, &comparison.b};
    if (round % 2 == 1) std::swap(order[0], order[1]);
    for (ComparedBuild* const build : order) {
      RAVE_TRY(run_again(*build, options.workload, end));
    }
    if (round == 0) RAVE_TRY(check(options, comparison));
    ratios.push_back(comparison.b.robot_steps_per_s.back() / comparison.a.robot_steps_per_s.back());
  }
  comparison.ratio = spread_of(std::move(ratios));
  return comparison;
}

std::string comparison_json(const Comparison& comparison) {
  const nlohmann::ordered_json json = {{"workload", to_string(comparison.workload.sensing)},
                                       {"robots", comparison.workload.robots},
                                       {"threads", comparison.workload.threads},
                                       {"noise", to_string(comparison.workload.noise)},
                                       {"seed", comparison.workload.seed},
                                       {"steps", comparison.steps},
                                       {"rounds", comparison.a.robot_steps_per_s.size()},
                                       {"a", json_of(comparison.a)},
                                       {"b", json_of(comparison.b)},
                                       {"ratio", json_of(comparison.ratio)},
                                       {"same_hash", comparison.same_hash()}};
  return json.dump();
}

std::string comparison_text(const Comparison& comparison) {
  const Spread& ratio = comparison.ratio;
  return fmt::format(
      "B does {:.3f} times the robot-steps of A (p10 {:.3f}, p90 {:.3f}; {} rounds of "
      "{} steps); {}",
      ratio.median, ratio.p10, ratio.p90, comparison.a.robot_steps_per_s.size(), comparison.steps,
      comparison.same_hash() ? "the same hash" : "the hashes DIFFER: the runs are not the same");
}

}  // namespace rave::swarm
