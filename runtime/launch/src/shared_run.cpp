// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/shared_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "host_command.hpp"
#include "host_process.hpp"
#include "rave/base/file.hpp"
#include "rave/launch/managed_run.hpp"

namespace rave::launch {

/// The processes of the hosts that this process starts.
class SharedRun::Crew {
 public:
  /// Borrows `options`.
  Crew(const Options& options, const config::ScenarioFile& scenario, std::size_t hosts)
      : options_(options),
        restarts_(scenario.on_lost_host == config::LostHost::kRestart),
        more_s_(hosts > kFew ? kMore_s * static_cast<double>(hosts - kFew) : 0),
        patience_s_(std::max(kLeastPatience_s, scenario.host_timeout_s) + more_s_) {}

  Status start(const config::PlannedHost& host) {
    members_.push_back({host.name, 0, std::nullopt});
    return start(members_.back());
  }

  /// Starts again who has died, if that is wanted.
  void look_after() {
    for (Member& member : members_) {
      if (!member.process) continue;
      const auto code = member.process->wait(std::chrono::milliseconds(0));
      if (!code) continue;
      member.process.reset();
      member.code = code;
      if (*code == kGood) continue;
      options_.log.warn(
          "run", "the process of host `{}` exited with {}", member.name,
          *code < 0 ? fmt::format("signal {}", -*code) : fmt::format("code {}", *code));
      // Limited: a host that dies at once, as for a missing plug-in, would be started for ever.
      if (!restarts_ || member.starts >= kMostStarts) continue;
      if (auto started = start(member); !started) {
        options_.log.error("run", "host `{}` could not be restarted: {}", member.name,
                           started.error().message);
      }
    }
  }

  /// No host comes again: all that were to run have died before the run began.
  [[nodiscard]] bool all_dead() const {
    return !members_.empty() && std::ranges::none_of(members_, [](const Member& member) {
      return member.process || member.code == kGood;
    });
  }

  /// No host runs any more.
  [[nodiscard]] bool all_ended() const {
    return std::none_of(members_.begin(), members_.end(),
                        [](const Member& member) { return member.process.has_value(); });
  }

  /// Asks all to end.
  void interrupt() {
    for (const Member& member : members_) {
      if (member.process) member.process->interrupt();
    }
  }

  /// Waits for their ends. What went wrong, one sentence each.
  [[nodiscard]] std::vector<std::string> part() {
    const std::chrono::milliseconds patience(20'000 + static_cast<std::int64_t>(1e3 * more_s_));
    std::vector<std::string> problems;
    for (Member& member : members_) {
      if (member.process) {
        member.code = member.process->wait(patience);
        member.process.reset();
      }
      if (member.code == kGood) continue;
      problems.push_back(
          member.code
              ? fmt::format("host `{}`: see {}", member.name, member.folders.back().string())
              : fmt::format("host `{}` did not end and was killed", member.name));
    }
    return problems;
  }

  /// Where a host left what it knows; none of one that is elsewhere.
  [[nodiscard]] std::vector<std::filesystem::path> folders_of(std::string_view host) const {
    for (const Member& member : members_) {
      if (member.name == host) return member.folders;
    }
    return {};
  }

 private:
  static constexpr int kGood = 0;  ///< The exit code of a host whose run was whole.
  static constexpr int kMostStarts = 10;
  /// If this process is killed, its hosts wait this long for a process that takes its place.
  static constexpr double kLeastPatience_s = 60;
  /// Many hosts on a machine that has other work begin and end slowly: for each host above a few,
  /// the others have this much more time.
  static constexpr std::size_t kFew = 10;
  static constexpr double kMore_s = 6;
  struct Member {
    std::string name;
    int starts = 0;
    std::optional<HostProcess> process;
    std::optional<int> code{};
    std::vector<std::filesystem::path> folders{};  ///< Of each start.
  };

  Status start(Member& member) {
    const RunSettings& settings = options_.settings;
    ++member.starts;
    // Each start has a folder of its own: what an earlier one recorded is a part of the results.
    member.folders.push_back(
        options_.folder / "hosts" /
        (member.starts == 1 ? member.name : fmt::format("{}-{}", member.name, member.starts)));
    // The program of this build, not the one that PATH finds: versions of processes must be equal.
    std::vector<std::string> words = {settings.program.string(),
                                      "robot",
                                      (options_.folder / "scenario.yaml").string(),
                                      "--host",
                                      member.name,
                                      "--output",
                                      member.folders.back().string(),
                                      "--wait-for-manager",
                                      fmt::format("{}", patience_s_),
                                      "--with-parent",
                                      "--quiet"};
    for (const std::string& word : bus::words_of(settings.bus, options_.bus.run))
      words.push_back(word);
    for (const std::string& folder : settings.plugins) {
      words.insert(words.end(), {"--plugins", folder});
    }
    if (settings.no_picture) words.emplace_back("--no-picture");
    if (settings.no_record) words.emplace_back("--no-record");
    if (settings.arm) words.emplace_back("--arm");
    add_line(words);
    RAVE_TRY_ASSIGN(auto process, HostProcess::start(std::move(words)));
    member.process.emplace(std::move(process));
    return {};
  }

  void add_line(std::vector<std::string>& words) const {
    const LineArguments& line = options_.settings.line;
    if (!line.web) return;
    words.insert(words.end(), {"--web", *line.web});
    for (const auto& [option, value] :
         {std::pair("--web-key", line.web_key), std::pair("--web-certificate", line.certificate),
          std::pair("--web-certificate-key", line.key)}) {
      if (!value.empty()) words.insert(words.end(), {option, value});
    }
  }

  const Options& options_;
  bool restarts_;
  double more_s_;
  double patience_s_;
  std::vector<Member> members_;
};

SharedRun::SharedRun(const config::ExpandedScenario& scenario, std::size_t hosts, Options options)
    : scenario_(scenario),
      options_(std::move(options)),
      crew_(std::make_unique<Crew>(options_, scenario.scenario, hosts)) {}

SharedRun::~SharedRun() = default;

Result<std::unique_ptr<SharedRun>> SharedRun::start(const config::ExpandedScenario& scenario,
                                                    const std::vector<config::PlannedHost>& hosts,
                                                    Options options) {
  std::unique_ptr<SharedRun> run(new SharedRun(scenario, hosts.size(), std::move(options)));
  const Options& own = run->options_;
  RAVE_TRY(write_private_file_atomically(own.folder / "scenario.yaml",
                                         config::write_expanded(scenario)));
  RAVE_TRY(check_hosts_fit(scenario, own.settings, hosts.size(), own.log));
  for (const config::PlannedHost& host : hosts) {
    if (host.elsewhere) {
      own.log.warn("run", "waiting for host `{}`; start it with: {}", host.name,
                   host_command(own.settings, host.name, own.bus.run));
      continue;
    }
    RAVE_TRY(run->crew_->start(host));
  }
  return run;
}

Result<runtime::RunOutcome> SharedRun::finish() {
  runtime::RunControl& control = options_.control;
  const auto stopping = [this, &control] {
    crew_->look_after();
    return control.stopping() || crew_->all_dead();
  };
  auto managed = manage_run({.scenario = scenario_,
                             .settings = options_.settings,
                             .bus = options_.bus,
                             .folder = options_.folder,
                             .log = options_.log,
                             .control = control,
                             .stopping = stopping,
                             .hosts_ended = [this] { return crew_->all_ended(); },
                             .on_progress = options_.on_progress});
  // In lock-step the last step tells them; after a failure of the manager nothing does.
  if (!managed || (managed->live && control.stopping())) crew_->interrupt();
  std::vector<std::string> problems = crew_->part();
  if (!managed) return tl::unexpected(managed.error());
  runtime::SharedEnd& end = managed->end;
  end.problems.insert(end.problems.end(), problems.begin(), problems.end());
  for (runtime::SharedHost& host : end.hosts) host.folders = crew_->folders_of(host.name);
  return managed->results->write(end);
}

}  // namespace rave::launch
