// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/command_box.hpp"

#include <utility>

#include "rave/bus/sequence.hpp"

namespace rave::bus {

Result<std::unique_ptr<CommandBox>> CommandBox::create(Bus& bus, BeginCommand begin, LogSink* log) {
  if (!begin) return std::unique_ptr<CommandBox>();
  std::unique_ptr<CommandBox> box(new CommandBox(CommandBook(std::move(begin), log)));
  RAVE_TRY(open_all(bus, box->commands_, box->answers_));
  return box;
}

void CommandBox::serve() {
  commands_.take(
      [this](const Command& command) { book_.hear(command, CommandBook::Clock::now()); });
  // Fast path: most steps have no commands.
  if (book_.idle()) return;
  for (const CommandBook::Reply& reply : book_.take()) {
    CommandAnswer answer{};
    answer.robot = reply.robot;
    answer.target = reply.target;
    answer.number = reply.number;
    answer.accepted = reply.result.accepted;
    borrow_text(answer.text, reply.result.text);
    // A lost answer is sent again when the command is repeated.
    static_cast<void>(answers_.write(answer));
  }
}

}  // namespace rave::bus
