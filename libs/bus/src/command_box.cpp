// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/command_box.hpp"

#include <utility>

namespace rave::bus {

Result<std::unique_ptr<CommandBox>> CommandBox::create(Bus& bus, OnCommand tell) {
  if (!tell) return std::unique_ptr<CommandBox>();
  RAVE_TRY_ASSIGN(auto commands, Reader<Command>::create(bus));
  return std::unique_ptr<CommandBox>(new CommandBox(std::move(commands), std::move(tell)));
}

void CommandBox::serve() {
  commands_.take([this](const Command& command) { tell_(command); });
}

}  // namespace rave::bus
