// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"

namespace rave::bus {

/// What is done with a command of a person, in the thread of the bus; the sample has passed
/// bus::validate() and holds during the call alone.
using OnCommand = std::function<void(const Command&)>;

/// Hears what people ask of robots many times a second (topic rave/command), and answers nothing:
/// who wants an answer makes a wish. Must be gone before its bus; thread: that of the bus.
class CommandBox {
 public:
  /// Null if nobody is told. Errors: those of Reader::create().
  [[nodiscard]] static Result<std::unique_ptr<CommandBox>> create(Bus& bus, OnCommand tell);

  /// Wakes whoever waits when a command comes.
  [[nodiscard]] Status wake(WaitSet& waits) const { return waits.add(commands_); }
  /// Passes on what has come.
  void serve();

 private:
  CommandBox(Reader<Command> commands, OnCommand tell)
      : commands_(std::move(commands)), tell_(std::move(tell)) {}

  Reader<Command> commands_;
  OnCommand tell_;
};

}  // namespace rave::bus
