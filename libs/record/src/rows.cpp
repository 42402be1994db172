// SPDX-License-Identifier: Apache-2.0
// Finds rows again in what was read, so that a merged recording is no larger than its parts.
#include "rows.hpp"

namespace rave::record {
namespace {

using RowBytes = std::span<const std::byte>;

bool same_row(const Percept& a, const Percept& b) {
  return a.sensor == b.sensor && a.kind == b.kind && a.part == b.part && a.header == b.header;
}
bool same_row(const CommandRecord& a, const CommandRecord& b) {
  return a.controller == b.controller;
}

RowBytes bytes_of(const Percept& percept) { return percept.records; }
RowBytes bytes_of(const CommandRecord& command) { return command.command; }

/// The number of items from `begin` on that form one row.
/// Decoding has cut the rows of a recording into items that point into one message. Items that
/// follow each other in ids and in memory were one row, and are written as one again.
template <class Item>
std::uint32_t row_length(const std::vector<Item>& items, std::size_t begin) {
  const Item& first = items[begin];
  const RowBytes bytes = bytes_of(first);
  std::uint32_t length = 1;
  for (; begin + length < items.size() && !bytes.empty(); ++length) {
    const Item& item = items[begin + length];
    const RowBytes own = bytes_of(item);
    if (item.robot.value() != first.robot.value() + length || !same_row(first, item) ||
        own.size() != bytes.size() || own.data() != bytes.data() + length * bytes.size()) {
      break;
    }
  }
  return length;
}

}  // namespace

void add_rows(const std::vector<Percept>& percepts, RunRecorder& recorder) {
  for (std::size_t i = 0; i < percepts.size();) {
    const Percept& first = percepts[i];
    // Halves of hybrid sensors are never in rows.
    const std::uint32_t robots = first.part == PerceptPart::kResult ? row_length(percepts, i) : 1;
    if (robots == 1) {
      recorder.percept(first);
    } else {
      recorder.percepts({first.robot,
                         robots,
                         first.sensor,
                         first.kind,
                         first.header,
                         {first.records.data(), first.records.size() * robots}});
    }
    i += robots;
  }
}

void add_rows(const std::vector<CommandRecord>& commands, RunRecorder& recorder) {
  for (std::size_t i = 0; i < commands.size();) {
    const CommandRecord& first = commands[i];
    const std::uint32_t robots = row_length(commands, i);
    if (robots == 1) {
      recorder.command(first);
    } else {
      recorder.commands({first.robot,
                         robots,
                         first.controller,
                         {first.command.data(), first.command.size() * robots}});
    }
    i += robots;
  }
}

}  // namespace rave::record
