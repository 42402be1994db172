// SPDX-License-Identifier: Apache-2.0
#include "commands/gui.hpp"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <utility>

#include "console.hpp"
#include "error_text.hpp"
#include "managed_run.hpp"
#include "places.hpp"
#include "rave/host/host_run.hpp"
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

Result<std::unique_ptr<gui_server::GuiServer>> serve(const GuiCommand& options,
                                                     Afterwards& afterwards) {
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
  RAVE_TRY_ASSIGN(auto bus, bus_config(run.bus, "GUI Server", runtime::shared_number(*scenario)));
  make_room(bus, kMostHosts);
  Console console(false);
  return show_run(
      run, *scenario, bus, nullptr, console,
      [&afterwards](std::shared_ptr<gui_server::Source> replay, const std::string& where) {
        afterwards.take(std::move(replay), where);
      });
}

}  // namespace

Result<int> gui(const GuiCommand& options) {
  // Before the server has threads, so that none of them gets the signals.
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);

  Afterwards afterwards;
  RAVE_TRY_ASSIGN(const auto server, serve(options, afterwards));
  afterwards.set_page(server.get());
  int signal = 0;
  sigwait(&signals, &signal);
  afterwards.set_page(nullptr);
  return kGood;
}

}  // namespace rave::cli
