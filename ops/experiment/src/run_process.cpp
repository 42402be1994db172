// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment/run_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <string_view>

#include "rave/base/file.hpp"
#include "rave/codec/nodes.hpp"
#include "rave/experiment/metric.hpp"
#include "rave/process/child.hpp"

namespace rave::experiment {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kLargestResult = std::size_t{64} << 20;
constexpr std::size_t kLongestReason = 300;

fs::path output_file(const fs::path& folder) { return folder.string() + ".err"; }

std::vector<std::string> words_of(const Plan& plan, const PlannedRun& run,
                                  const RunProcessOptions& options) {
  std::vector<std::string> words = {options.program, "run", plan.scenario};
  for (const std::string& setting : plan.conditions[run.condition].condition.settings) {
    words.insert(words.end(), {"--set", setting});
  }
  words.insert(words.end(), {"--seed", std::to_string(run.seed), "--threads", "1", "--pace", "max",
                             "--output", options.folder, "--replace", "--quiet", "--no-picture",
                             "--end-with-parent", std::to_string(::getpid())});
  if (!options.record) words.emplace_back("--no-record");
  words.insert(words.end(), options.arguments.begin(), options.arguments.end());
  return words;
}

/// The line of a run's messages that says most: the first one that is no note. The same wherever
/// the run was.
std::string first_message(const fs::path& folder) {
  const auto text = read_file(output_file(folder), kLargestResult);
  if (!text) return "no message";
  std::string_view rest = *text;
  std::string line;
  while (!rest.empty() && (line.empty() || line.starts_with("note:"))) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  for (std::size_t at = 0; (at = line.find(folder.string(), at)) != std::string::npos;) {
    line.replace(at, folder.string().size(), "its folder");
  }
  if (line.size() > kLongestReason) line.resize(kLongestReason);
  return line.empty() ? "no message" : line;
}

/// The reason of a run that a signal ended.
std::string signal_text(int number) {
  return fmt::format("ended by signal {} ({})", number, ::strsignal(number));
}

/// Fills in what the results say.
Status read_results(const Plan& plan, const fs::path& folder, RunRow& row) {
  const auto text = read_file(folder / "result.json", kLargestResult);
  if (!text) {
    row.failure = first_message(folder);
    return {};
  }
  const auto result = codec::parse_json(*text, {.depth = 16, .nodes = 4'000'000});
  if (!result) {
    row.failure = "its result.json cannot be read: " + result.error().message;
    return {};
  }
  row.simulated_s = number_at(*result, "simulated_s").value_or(0.0).value_or(0.0);
  if (const auto* hash = result->find("hash"); hash != nullptr && hash->is_scalar()) {
    row.hash = hash->scalar();
  }
  const auto* const whole = result->find("whole");
  if (whole == nullptr || !whole->as_bool().value_or(false)) {
    const auto* const problems = result->find("problems");
    row.failure = problems != nullptr && problems->size() > 0 ? problems->child(0).scalar()
                                                              : "the run did not complete";
    return {};
  }
  for (const config::MetricFile& metric : plan.experiment.metrics) {
    auto value = value_of(metric, *result);
    if (!value) {
      return fail_at(metric.value.where, value.error().code, "the metric `{}`: {}", *metric.name,
                     value.error().message);
    }
    row.values.push_back(*value);
  }
  return {};
}

/// How the process ended; empty: `stop` or the limit of time ended it.
struct Waited {
  std::optional<process::ChildEnd> end;
  bool stopped = false;
};

Waited wait_for(process::Child& child, double limit_s, const std::function<bool()>& stop) {
  using std::chrono::milliseconds;
  const auto until = Clock::now() + std::chrono::duration<double>(limit_s);
  while (true) {
    if (auto end = child.wait(milliseconds(50))) return {end, false};
    const bool stopped = stop && stop();
    if (!stopped && Clock::now() < until) continue;
    child.kill();
    return {std::nullopt, stopped};
  }
}

}  // namespace

Result<std::optional<RunRow>> run_process(const Plan& plan, const PlannedRun& run,
                                          const RunProcessOptions& options) {
  const auto began = Clock::now();
  const config::RunLimitsFile& limits = plan.experiment.limits;
  Descriptor messages(
      ::open(output_file(options.folder).c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600));
  if (!messages) {
    return fail(ErrorCode::kIo, "cannot write `{}`", output_file(options.folder).string());
  }
  process::ChildOptions how;
  how.words = words_of(plan, run, options);
  how.files = {{messages.get(), 1}, {messages.get(), 2}};
  how.no_input = true;
  how.close_from = 3;
  how.default_signals = true;
  how.own_group = true;
  RAVE_TRY_ASSIGN(auto child, process::Child::start(how));
  if (limits.memory_mb) {
    const auto bytes = static_cast<rlim_t>(*limits.memory_mb * 1e6);
    const rlimit most{bytes, bytes};
    ::prlimit(child.id(), RLIMIT_AS, &most, nullptr);
  }
  const Waited waited = wait_for(child, limits.wall_s, options.stop);
  if (waited.stopped) return std::optional<RunRow>();
  RunRow row;
  row.inputs = plan.conditions[run.condition].inputs;
  row.seed = run.seed;
  using std::chrono::milliseconds;
  row.wall_s = 1e-3 * static_cast<double>(
                          std::chrono::duration_cast<milliseconds>(Clock::now() - began).count());
  if (!waited.end) {
    row.failure = fmt::format("no end within {:g} s of wall time", limits.wall_s);
  } else if (waited.end->signal) {
    // A run that crashes says in what.
    const std::string message = first_message(options.folder);
    row.failure = signal_text(*waited.end->signal);
    if (message.starts_with("rave: ")) row.failure += ": " + message;
  } else {
    RAVE_TRY(read_results(plan, options.folder, row));
  }
  return std::optional<RunRow>(std::move(row));
}

}  // namespace rave::experiment
