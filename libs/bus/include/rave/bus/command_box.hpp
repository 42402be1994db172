// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"

namespace rave::bus {

/// Handles a command of a user interface, in the thread of the bus. The sample has passed
/// bus::validate() and is valid during the call only.
using OnCommand = std::function<void(const Command&)>;

/// Receives commands that users send to robots many times a second (topic rave/command). It sends
/// no replies; requests that need a reply go through RequestBox. Destroy it before its bus; thread:
/// that of the bus.
class CommandBox {
 public:
  /// Returns null if `tell` is empty. Errors: those of Reader::create().
  [[nodiscard]] static Result<std::unique_ptr<CommandBox>> create(Bus& bus, OnCommand tell);

  /// Makes `waits` wake up when a command arrives.
  [[nodiscard]] Status wake(WaitSet& waits) const { return waits.add(commands_); }
  /// Passes the received commands to the handler.
  void serve();

 private:
  explicit CommandBox(OnCommand tell) : tell_(std::move(tell)) {}

  Reader<Command> commands_;
  OnCommand tell_;
};

}  // namespace rave::bus
