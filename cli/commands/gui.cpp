// SPDX-License-Identifier: Apache-2.0
#include "commands/gui.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <thread>
#include <utility>

#include "console.hpp"
#include "error_text.hpp"
#include "places.hpp"
#include "rave/base/thread.hpp"
#include "rave/client/bus_search.hpp"
#include "rave/client/sought_run.hpp"
#include "rave/protocol/agreement.hpp"
#include "run_conductor.hpp"
#include "run_page.hpp"
#include "run_people.hpp"
#include "run_scenario.hpp"

namespace rave::cli {
namespace {

/// Shows the recording of a run that is over on the page of the run, whichever is there first.
class Afterwards {
 public:
  /// Any thread.
  void take(std::shared_ptr<gui_server::Source> replay, const std::string& where) {
    const std::lock_guard lock(mutex_);
    put(stdout, replay ? "the run is over; the page shows its recording\n"
                       : fmt::format("the run is over. {}\n", where));
    std::fflush(stdout);
    replay_ = std::move(replay);
    show();
  }
  /// The page, until it ends (null).
  void set_page(gui_server::GuiServer* page) {
    const std::lock_guard lock(mutex_);
    page_ = page;
    show();
  }

 private:
  void show() {
    if (page_ != nullptr && replay_) page_->show(std::exchange(replay_, nullptr));
  }

  std::mutex mutex_;
  gui_server::GuiServer* page_ = nullptr;       ///< Guarded by the mutex.
  std::shared_ptr<gui_server::Source> replay_;  ///< Guarded by the mutex.
};

/// The page of a scenario, whose run may start later.
class ScenarioPage {
 public:
  ScenarioPage(RunCommand options, config::ExpandedScenario scenario, Afterwards& afterwards)
      : options_(std::move(options)),
        scenario_(std::move(scenario)),
        afterwards_(afterwards),
        seeker_(scenario_) {}

  Result<std::unique_ptr<gui_server::GuiServer>> serve() {
    RAVE_TRY_ASSIGN(bus_,
                    bus::bus_config(options_.bus, "GUI Server", runtime::shared_number(scenario_)));
    bus::make_room(bus_, bus::kMostHosts);
    // The search has a bus of its own.
    bus_.beside = true;
    // A run that is named has that number, whatever it runs.
    named_ = !options_.bus.run.empty();
    if (!named_) RAVE_TRY(seek(client::search_patience(bus_), {}));
    return show_run(options_, scenario_, bus_, nullptr, console_, when_over());
  }

  /// Shows the run on the page when it is found, if that has not been yet. Stops when destroyed,
  /// which comes before the end of the page.
  Status seek_on(gui_server::GuiServer& page) {
    if (named_ || found_) return {};
    return start_thread(
        thread_, "the search for the run", [this, &page](const std::stop_token& stop) {
          const bus::RunId before = bus_.run;
          while (!found_ && !stop.stop_requested()) {
            const Status looked = seek(from_seconds(3600), stop);
            if (!looked) return tell(looked.error());
          }
          if (!found_ || bus_.run == before) return;
          auto source = look_on(options_, scenario_, bus_, nullptr, console_, when_over());
          if (!source) return tell(source.error());
          page.show(*std::move(source));
          if (const Status lines = offer_lines(options_, scenario_, bus_, page); !lines) {
            tell(lines.error());
          }
        });
  }

 private:
  Status seek(Duration patience, const std::stop_token& stop) {
    RAVE_TRY_ASSIGN(auto sought, seeker_.seek(bus_, patience, stop));
    if (!sought) return {};
    found_ = true;
    bus_.run = sought->run;
    scenario_ = std::move(sought->scenario);
    if (sought->differs) {
      console_.warn("gui",
                    "run {} of `{}` has another seed, duration or files than given here; its world "
                    "may look different",
                    bus_.run.text().substr(0, 8), scenario_.scenario.name.value);
    }
    return {};
  }
  gui_server::OnOver when_over() {
    return [&afterwards = afterwards_](std::shared_ptr<gui_server::Source> replay,
                                       const std::string& where) {
      afterwards.take(std::move(replay), where);
    };
  }
  void tell(const Error& error) { console_.error("gui", "{}", error.text()); }

  RunCommand options_;
  config::ExpandedScenario scenario_;
  Afterwards& afterwards_;
  client::RunSeeker seeker_;
  Console console_{false};
  bus::BusConfig bus_;
  bool named_ = false;
  bool found_ = false;
  std::jthread thread_;  ///< Alone with the rest from its start on.
};

Result<std::unique_ptr<gui_server::GuiServer>> serve(const GuiCommand& options,
                                                     Afterwards& afterwards,
                                                     std::unique_ptr<ScenarioPage>& page) {
  const auto file = record_file(options.file);
  std::error_code error;
  // A scenario may be given by its file, as `rave run` takes it.
  const bool yaml = std::filesystem::path(options.file).extension() == ".yaml";
  if (!yaml && file && std::filesystem::exists(*file, error)) {
    RAVE_TRY_ASSIGN(auto source, gui_server::open_recording(*file));
    return serve_page(options.page, std::move(source));
  }
  RunCommand run = options.run;
  run.scenario = options.file;
  run.page = options.page;
  const auto scenario = read_scenario(run);
  // A scenario that names a missing file is another error.
  const bool missing = !std::filesystem::exists(options.file, error);
  if (!scenario && missing && scenario.error().code == ErrorCode::kNotFound) {
    return fail(ErrorCode::kNotFound, "`{}` is not a recording, the folder of a run, or a scenario",
                options.file);
  }
  if (!scenario) return tl::unexpected(scenario.error());
  page = std::make_unique<ScenarioPage>(std::move(run), *scenario, afterwards);
  return page->serve();
}

/// A page that outlives the runs that it starts.
Result<int> stay(const GuiCommand& options, const sigset_t& signals) {
  RunCommand run = options.run;
  run.page = options.page;
  RAVE_TRY_ASSIGN(const auto people, RunPeople::of_page(run.page));
  RAVE_TRY_ASSIGN(const auto server, serve_page(run.page));
  RAVE_TRY_ASSIGN(const auto conductor, RunConductor::start(run, *server));
  int signal = 0;
  sigwait(&signals, &signal);
  conductor->close();
  return kGood;
}

}  // namespace

Result<int> gui(const GuiCommand& options) {
  // Before the server has threads, so that none of them gets the signals.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  if (options.file.empty()) return stay(options, signals);
  Afterwards afterwards;
  std::unique_ptr<ScenarioPage> page;
  RAVE_TRY_ASSIGN(const auto server, serve(options, afterwards, page));
  afterwards.set_page(server.get());
  if (page) RAVE_TRY(page->seek_on(*server));
  int signal = 0;
  sigwait(&signals, &signal);
  page.reset();
  afterwards.set_page(nullptr);
  return kGood;
}

}  // namespace rave::cli
