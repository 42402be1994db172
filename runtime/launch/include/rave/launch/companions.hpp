// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/config/companion_file.hpp"
#include "rave/control/run_control.hpp"

namespace rave::launch {

/// The other programs of a run: `companions:` of a scenario. Each is started by `rave-keeper`,
/// which ends it and all that it started with this object, or when this process dies. Their output
/// is in NAME.log of their common folder. One owner thread.
class Companions {
 public:
  struct Options {
    std::filesystem::path program;  ///< The program `rave` of this installation.
    std::filesystem::path folder;  ///< Absolute; see folder_of_run(). Made if there are companions.
    LogSink& log;                  ///< Not owned; outlives this object.
    runtime::RunControl& control;  ///< Of the run. Not owned; outlives this object.
  };

  /// Whether the programs exist, before anything is started. `rave`: the program of this
  /// installation. Error kNotFound at the first that does not.
  [[nodiscard]] static Status find(const std::vector<config::CompanionFile>& companions,
                                   const std::filesystem::path& rave);
  /// The folder of the companions of a run that leaves its results in `run`.
  [[nodiscard]] static std::filesystem::path folder_of_run(const std::filesystem::path& run);

  /// Starts the companions one after the other and waits until each is ready. From then on it is
  /// reported if one ends. Errors: those of find(); kIo (the folder, a process); kState at the
  /// companion that is not ready.
  [[nodiscard]] static Result<std::unique_ptr<Companions>> start(
      const std::vector<config::CompanionFile>& companions, Options options);
  Companions(const Companions&) = delete;
  Companions& operator=(const Companions&) = delete;
  /// As end().
  ~Companions();

  /// Ends all of them. What went wrong, one sentence each: companions with which the run had to
  /// end.
  std::vector<std::string> end();

 private:
  class Member;
  explicit Companions(Options options);
  void watch(const std::stop_token& stop);
  void look_after(Member& member);

  Options options_;
  std::vector<std::unique_ptr<Member>> members_;
  std::vector<std::string> problems_;
  std::mutex mutex_;
  std::condition_variable_any stopped_;
  std::jthread watcher_;  ///< Owns the members while it runs.
};

}  // namespace rave::launch
