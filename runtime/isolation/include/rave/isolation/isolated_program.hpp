// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "rave/base/result.hpp"
#include "rave/robot/program.hpp"

namespace rave::isolation {

/// Executable, plug-in and timeouts of a program in a process of its own.
struct IsolationOptions {
  std::filesystem::path runner;   ///< The executable `rave-program-runner`.
  std::filesystem::path plugin;   ///< The plug-in file that registers `program`.
  std::string program;            ///< Name under which the program is registered.
  double decide_timeout_s = 1.0;  ///< Timeout in wall time from begin_decide(); above 0.
  double start_timeout_s = 5.0;   ///< Timeout in wall time for loading and starting; above 0.
  double last_word_s = 0.2;       ///< Wall time to report where it hangs before it is killed.
};

/// A robot program in a child process, so that a crash or an endless loop affects only its robot.
/// Its decisions are bit-identical to those inside the host. Owns the child, which ends with this
/// object and with the host, however that ends. One thread at a time per object; objects are
/// independent, so a host begins the decisions of all its children before it ends the first.
class IsolatedProgram {
 public:
  /// Starts the child, loads the plug-in there and calls the program's start(). Data that `setup`
  /// points to is copied, except `setup.host`, which must live as long as the object and whose
  /// log() is called in the thread that calls start() and end_decide(). Errors: kInvalidArgument,
  /// kIo and kNotFound (the runner cannot be started), kNotFound, kParse and kIncompatible (the
  /// plug-in cannot be used), kPlugin (the program gave an error, threw or crashed), kTimeout. The
  /// message names program, robot and, if known, source line.
  [[nodiscard]] static Result<std::unique_ptr<IsolatedProgram>> start(
      const IsolationOptions& options, const ProgramSetup& setup);

  /// Asks the child to end and kills it if it does not end at once.
  ~IsolatedProgram();
  IsolatedProgram(const IsolatedProgram&) = delete;
  IsolatedProgram& operator=(const IsolatedProgram&) = delete;

  /// Copies percepts and present commands to the child and wakes it. `item` has the sensors and
  /// commands of the setup, in the same order; a sensor has at most its capacity of records.
  /// Errors: kInvalidArgument, kState (a decision is in progress), and every earlier failure.
  [[nodiscard]] Status begin_decide(const DecideItem& item);

  /// Waits for the decision in progress until the timeout, and copies the commands to
  /// `item.commands`, which are unchanged on failure. Log lines of the program are delivered here.
  /// Errors: kState (no decision in progress); kPlugin (the program threw, crashed or ended),
  /// kTimeout. After the latter two the child is gone and every later call returns the same error.
  [[nodiscard]] Status end_decide(const DecideItem& item);

  /// Passes new values of all parameters and the radius of the robot's body to the program, between
  /// two decisions. Errors: kInvalidArgument (the program refuses, or the values are too long for a
  /// message; nothing changes); kState (a decision is in progress); kPlugin and kTimeout as in
  /// end_decide().
  [[nodiscard]] Status update(std::span<const ParamValue> params, double radius_m);

  /// The child's process id; 0 once it is gone.
  [[nodiscard]] int process_id() const noexcept;

 private:
  struct Impl;
  explicit IsolatedProgram(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::isolation
