// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "rave/bus/command_book.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"

namespace rave::bus {

/// Receives the orders that users send to robots over the bus (topic rave/command), and sends the
/// answers (rave/command_answer). Requests that are rare go through RequestBox. Destroy it before
/// its bus; thread: that of the bus.
class CommandBox {
 public:
  /// `log` is not owned and may be null. Returns null if `begin` is empty. Errors: those of
  /// Writer::create().
  [[nodiscard]] static Result<std::unique_ptr<CommandBox>> create(Bus& bus, BeginCommand begin,
                                                                  LogSink* log);

  /// Makes `waits` wake up when a command arrives.
  [[nodiscard]] Status wake(WaitSet& waits) const { return waits.add(commands_); }
  /// Begins the received commands and sends the available answers. Does not block.
  void serve();

 private:
  explicit CommandBox(CommandBook book) : book_(std::move(book)) {}

  Reader<Command> commands_;
  Writer<CommandAnswer> answers_;
  CommandBook book_;
};

}  // namespace rave::bus
