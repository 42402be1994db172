// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/control/run_control.hpp"

namespace rave::control {

/// Sends orders to the robots of a run over the bus (topic rave/command) and receives the answers
/// of their hosts. It is not part of the run. Many orders can wait at the same time. Thread-safe.
class CommandSender {
 public:
  /// `config.run` must be the id of the run. `robots`: the names of all, by id. `answered` is
  /// called after each answer, in a thread of the sender, and may be empty. Errors: those of
  /// bus::Bus::open(), kIo (the system grants no thread).
  [[nodiscard]] static Result<std::unique_ptr<CommandSender>> open(
      bus::BusConfig config, const std::vector<std::string>& robots,
      std::function<void()> answered = {});
  CommandSender(const CommandSender&) = delete;
  CommandSender& operator=(const CommandSender&) = delete;
  /// Orders without an answer get the error kState.
  ~CommandSender();

  /// Sends an order. The future is set when its host has answered; for a drive, which gets no
  /// answer, when it is on its way. Its errors: kState (refused), kTimeout (no answer for 5 s).
  /// Errors: kNotFound (no such robot), kInvalidArgument (those of to_command()).
  [[nodiscard]] Result<std::future<Result<std::string>>> post(request::Request order);

 private:
  struct Impl;
  explicit CommandSender(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::control
