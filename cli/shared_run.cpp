// SPDX-License-Identifier: Apache-2.0
#include "shared_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "console.hpp"
#include "error_text.hpp"
#include "host_command.hpp"
#include "host_process.hpp"
#include "managed_run.hpp"
#include "places.hpp"
#include "rave/base/file.hpp"
#include "rave/control/folder.hpp"
#include "rave/direct_line/key_files.hpp"
#include "rave/host/host_run.hpp"
#include "run_report.hpp"
#include "run_start.hpp"

namespace rave::cli {
namespace {

/// The processes of the hosts that `rave run` starts.
class Crew {
 public:
  Crew(const RunCommand& options, const bus::BusConfig& bus, std::filesystem::path folder,
       const config::ScenarioFile& scenario, std::size_t hosts, Console& console)
      : options_(options),
        bus_(bus),
        folder_(std::move(folder)),
        restarts_(scenario.on_lost_host == config::LostHost::kRestart),
        more_s_(hosts > kFew ? kMore_s * static_cast<double>(hosts - kFew) : 0),
        patience_s_(std::max(kLeastPatience_s, scenario.host_timeout_s) + more_s_),
        console_(console) {}

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
      console_.warn("run", "the process of host `{}` exited with {}", member.name,
                    *code < 0 ? fmt::format("signal {}", -*code) : fmt::format("code {}", *code));
      // Limited: a host that dies at once, as for a missing plug-in, would be started for ever.
      if (!restarts_ || member.starts >= kMostStarts) continue;
      if (auto started = start(member); !started) {
        console_.error("run", "host `{}` could not be restarted: {}", member.name,
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
    ++member.starts;
    // Each start has a folder of its own: what an earlier one recorded is a part of the results.
    member.folders.push_back(
        folder_ / "hosts" /
        (member.starts == 1 ? member.name : fmt::format("{}-{}", member.name, member.starts)));
    // The program of this build, not the one that PATH finds: versions of processes must be equal.
    std::vector<std::string> words = {(executable_folder() / "rave").string(),
                                      "robot",
                                      (folder_ / "scenario.yaml").string(),
                                      "--host",
                                      member.name,
                                      "--output",
                                      member.folders.back().string(),
                                      "--wait-for-manager",
                                      fmt::format("{}", patience_s_),
                                      "--quiet"};
    for (const std::string& word : words_of(options_.bus, bus_.run)) words.push_back(word);
    for (const std::string& folder : options_.plugins) {
      words.insert(words.end(), {"--plugins", folder});
    }
    if (options_.no_picture) words.emplace_back("--no-picture");
    if (options_.no_record) words.emplace_back("--no-record");
    if (options_.arm) words.emplace_back("--arm");
    add_line(words);
    RAVE_TRY_ASSIGN(auto process, HostProcess::start(std::move(words)));
    member.process.emplace(std::move(process));
    return {};
  }

  void add_line(std::vector<std::string>& words) const {
    const LineArguments& line = options_.line;
    if (!line.web) return;
    words.insert(words.end(), {"--web", *line.web});
    for (const auto& [option, value] :
         {std::pair("--web-key", line.web_key), std::pair("--web-certificate", line.certificate),
          std::pair("--web-certificate-key", line.key)}) {
      if (!value.empty()) words.insert(words.end(), {option, value});
    }
  }

  const RunCommand& options_;
  const bus::BusConfig& bus_;
  std::filesystem::path folder_;
  bool restarts_;
  double more_s_;
  double patience_s_;
  Console& console_;
  std::vector<Member> members_;
};

/// The most hosts with a line that find each other.
constexpr std::size_t kMostLines = 50;

/// Whether the hosts have direct lines: with a page, unless they are too many.
bool wants_lines(const RunCommand& options, std::size_t hosts) {
  return options.line.web.has_value() || (options.gui && hosts <= kMostLines);
}

/// Gives the hosts what they need for a line, and the page the key, unless they were told of.
Status make_lines(RunCommand& options, const std::filesystem::path& folder) {
  LineArguments& line = options.line;
  if (!line.web) {
    line.web = options.page.listen + ":0";
    line.certificate = options.page.certificate;
    line.key = options.page.key;
  }
  if (!line.web_key.empty() || !options.gui) return {};
  if (options.page.line_key.empty()) {
    options.page.line_key = folder / "line_key";
    RAVE_TRY(direct_line::make_key_files(options.page.line_key));
  }
  line.web_key = options.page.line_key + ".pub";
  return {};
}

/// Puts together what all have left.
Result<runtime::RunOutcome> put_together(ManagedEnd& managed, const Crew& crew,
                                         const std::vector<std::string>& problems) {
  runtime::SharedEnd& end = managed.end;
  end.problems.insert(end.problems.end(), problems.begin(), problems.end());
  for (runtime::SharedHost& host : end.hosts) host.folders = crew.folders_of(host.name);
  return managed.results->write(end);
}

}  // namespace

Result<int> run_shared(const RunCommand& asked, const config::ExpandedScenario& scenario,
                       const std::vector<config::PlannedHost>& hosts) {
  RunCommand options = asked;
  BusOptions bus_options = options.bus;
  // A run that this process starts is one of its own, even if the same scenario runs elsewhere on
  // the bus.
  if (bus_options.run.empty()) bus_options.run = bus::RunId::random().text();
  RAVE_TRY_ASSIGN(auto bus,
                  bus_config(bus_options, "environment manager", runtime::shared_number(scenario)));
  const bool lines = wants_lines(options, hosts.size());
  // A line has an end of its own on the bus.
  make_room(bus, lines ? 2 * hosts.size() : hosts.size(), bus::Reach::kHub);
  RAVE_TRY_ASSIGN(const auto opened, RunStart::open(options, scenario.scenario.name.value));
  RunStart& start = *opened;
  Console& console = start.console();
  RAVE_TRY(write_private_file_atomically(start.path() / "scenario.yaml",
                                         config::write_expanded(scenario)));
  RAVE_TRY(check_hosts_fit(scenario, options.plugins, hosts.size(), console));
  RAVE_TRY(lines ? make_lines(options, start.path()) : Status());
  Crew crew(options, bus, start.path(), scenario.scenario, hosts.size(), console);
  for (const config::PlannedHost& host : hosts) {
    if (host.elsewhere) {
      console.warn("run", "waiting for host `{}`; start it with: {}", host.name,
                   host_command(options, host.name, bus.run));
      continue;
    }
    RAVE_TRY(crew.start(host));
  }
  runtime::RunControl& control = start.control();
  start.serve(control::own_run_name(scenario.scenario.name.value), "run", "this run");
  const auto stopping = [&] {
    crew.look_after();
    return control.stopping() || crew.all_dead();
  };
  std::unique_ptr<gui_server::GuiServer> page;
  if (options.gui) {
    RAVE_TRY_ASSIGN(page, show_run(options, scenario, bus, &control, console));
  }
  auto managed = manage_run({scenario, options, bus, start.path(), console, control, stopping,
                             [&crew] { return crew.all_ended(); }});
  // In lock-step the last step tells them; after a failure of the manager nothing does.
  if (!managed || (managed->live && control.stopping())) crew.interrupt();
  const std::vector<std::string> problems = crew.part();
  console.clear();
  if (!managed) return tl::unexpected(managed.error());
  RAVE_TRY_ASSIGN(const auto outcome, put_together(*managed, crew, problems));
  const int code = report_outcome(options, outcome, start.path(), console);
  if (page) replay_on_page(*page, options.quiet, start.path(), control);
  return code;
}

}  // namespace rave::cli
