// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/command_box.hpp"

#include <utility>

namespace rave::bus {

Result<std::unique_ptr<CommandBox>> CommandBox::create(Bus& bus, OnCommand tell) {
  if (!tell) return std::unique_ptr<CommandBox>();
  std::unique_ptr<CommandBox> box(new CommandBox(std::move(tell)));
  RAVE_TRY(box->commands_.open(bus));
  return box;
}

void CommandBox::serve() {
  commands_.take([this](const Command& command) { tell_(command); });
}

}  // namespace rave::bus
