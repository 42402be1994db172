// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "commands/run.hpp"
#include "conducted_run.hpp"
#include "console.hpp"
#include "rave/base/result.hpp"
#include "rave/gui_server/conductor.hpp"
#include "rave/gui_server/gui_server.hpp"
#include "run_list.hpp"

namespace rave::cli {

/// Starts the runs that pages ask for, one at a time, and shows each on the page and then its
/// recording. Runs are processes of their own. Any thread.
class RunConductor final : public gui_server::Conductor {
 public:
  /// `options`: plug-ins, bus and page of all runs. `page` outlives it. Error: kIo (no thread).
  [[nodiscard]] static Result<std::shared_ptr<RunConductor>> start(const RunCommand& options,
                                                                   gui_server::GuiServer& page);
  /// Ends the run.
  ~RunConductor() override;
  /// Ends the run and waits for it; nothing is started any more.
  void close();

  [[nodiscard]] std::uint64_t revision() const override;
  [[nodiscard]] std::string text(bool whole) override;
  [[nodiscard]] Result<std::string> take(const gui_server::ConductMessage& message) override;

 private:
  enum class State : std::uint8_t { kStarting, kRunning, kEnding, kEnded, kFailed };
  /// The run in progress, or the last one.
  struct Told {
    std::string scenario;
    std::optional<std::uint64_t> seed{};
    State state = State::kStarting;
    std::string folder{};
    std::string text{};  ///< How it ended.
    std::uint32_t number = 0;
    int process = 0;         ///< Its id; 0: none.
    std::string due = "[]";  ///< What the scenario has in store.
    std::vector<std::string> log{};
  };

  RunConductor(const RunCommand& options, gui_server::GuiServer& page)
      : options_(options), page_(page) {}
  [[nodiscard]] static std::string_view word_of(State state) noexcept;
  [[nodiscard]] bool in_progress() const;
  void work(const std::stop_token& stop);
  void obey(const gui_server::ConductMessage& message);
  void begin(const std::string& scenario, std::optional<std::uint64_t> seed);
  void begin_again();
  [[nodiscard]] Status begin_process(const RunCommand& options);
  void look_after();
  void note_end(const process::ChildEnd& end);
  void show_recording(const std::filesystem::path& folder);
  /// Changes what pages receive.
  template <class Change>
  void tell(Change&& change) {
    const std::lock_guard lock(mutex_);
    change();
    ++revision_;
  }

  const RunCommand options_;
  gui_server::GuiServer& page_;
  Console console_{false};
  // Of the thread.
  std::unique_ptr<ConductedRun> run_;
  bool again_ = false;  ///< After its end the same once more.
  std::optional<std::uint64_t> again_seed_;

  mutable std::mutex mutex_;  // over all that follows
  std::condition_variable_any asked_;
  std::deque<gui_server::ConductMessage> messages_;
  std::optional<Told> told_;
  RunList list_;
  std::string shown_;  ///< The recording that is shown; empty: none.
  std::uint32_t starts_ = 0;
  std::uint64_t revision_ = 1;
  std::jthread thread_;
};

}  // namespace rave::cli
