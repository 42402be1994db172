// SPDX-License-Identifier: Apache-2.0
// The decide phase: programs of a block are called together, isolated ones in processes of their
// own. What they command is kept per controller, because controllers run more often than programs.
#include <algorithm>
#include <cmath>

#include "engine_impl.hpp"

namespace rave::sim {

void Engine::Impl::decide() {
  if (!orders.empty()) orders.show(step);
  pool.for_each_block(roster.blocks.size(), decide_effort, [this](std::size_t b, unsigned w) {
    decide_block(roster.blocks[b], workers[w]);
  });
  decide_isolated();
  if (answers.any()) orders.take_answers(order_moment(), answers);
  if (!orders.empty()) orders.hide();
}

namespace {

/// Fills in what changes from decision to decision.
void prepare(DecideItem& item, SimTime now, const ReportedPose& reported, std::uint32_t decision) {
  item.now_ns = now.ns;
  item.pose = reported.pose;
  item.decision = decision;
}

void mark_consumed(RobotGroup& group, std::size_t member) {
  for (SensorSlots& slots : group.sensors) slots.headers[member].fresh = 0;
}

// A program that says nothing in a decision gives no command. Without this, its last command would
// count as a new one, and the watchdog of the guard would never act.
void clear_commands(RobotGroup& group, std::size_t member) {
  const std::size_t controllers = group.controllers.size();
  Command* first = group.program.commands.data() + member * controllers;
  std::fill(first, first + controllers, Command{});
  group.program.states[member] = 0;
}

}  // namespace

void Engine::Impl::decide_block(const Block& block, Worker& worker) {
  RobotGroup& group = roster.groups[block.group];
  ProgramSlots& program = group.program;
  if (program.spec == nullptr) {
    for (std::uint32_t m = block.begin; m < block.end; ++m) mark_consumed(group, m);
    return;
  }
  if (!due(program.spec->period_steps, program.spec->phase_steps)) return;
  // The number of a decision names its random numbers; it counts decisions, not steps.
  const auto decision =
      static_cast<std::uint32_t>((step - program.spec->phase_steps) / program.spec->period_steps);
  for (std::uint32_t m = block.begin; m < block.end; ++m) {
    prepare(program.items[m], now, reported[group.members[m].value()], decision);
    clear_commands(group, m);
  }
  if (program.spec->isolate) return;  // in processes of their own: decide_isolated()
  std::uint8_t failed_before[kMemberBlock];
  std::copy(program.failed.begin() + block.begin, program.failed.begin() + block.end,
            failed_before);
  ErrorText error;
  {
    const CrashNote whose = crash_note(block, "program", program.spec->driver);
    const CrashScope scope(whose);
    program.spec->ops->decide(program.instances.at(block.begin), program.instances.stride(),
                              program.items.data() + block.begin, block.end - block.begin,
                              program.failed.data() + block.begin, &error);
  }
  for (std::uint32_t m = block.begin; m < block.end; ++m) {
    if (program.failed[m] != 0 && failed_before[m - block.begin] == 0) {
      // One text is kept per batch: that of the last one to fail.
      const bool own_text = error.slot == m - block.begin;
      fail_program(group, m, own_text ? error.text : "threw an exception", worker.events);
    }
    // A program that fails in this decision gives no command in it, even if it had set some before.
    if (program.failed[m] == 0) accept_commands(group, m, worker.hash);
    mark_consumed(group, m);
  }
}

void Engine::Impl::decide_isolated() {
  const auto for_each_due = [&](auto&& visit) {
    for (RobotGroup& group : roster.groups) {
      ProgramSlots& program = group.program;
      if (program.spec == nullptr || !program.spec->isolate ||
          !due(program.spec->period_steps, program.spec->phase_steps)) {
        continue;
      }
      for (std::size_t m = 0; m < group.members.size(); ++m) {
        if (program.failed[m] == 0) {
          visit(group, m);
        } else {
          mark_consumed(group, m);
        }
      }
    }
  };
  // All begin before the first is waited for, so that they decide at the same time.
  for_each_due([&](RobotGroup& group, std::size_t m) {
    const Status status = group.program.processes[m]->begin(group.program.items[m]);
    if (!status) fail_program(group, m, status.error().text(), events);
  });
  for_each_due([&](RobotGroup& group, std::size_t m) {
    const Status status = group.program.processes[m]->end(group.program.items[m]);
    if (status) {
      accept_commands(group, m, hash);
    } else {
      fail_program(group, m, status.error().text(), events);
    }
    mark_consumed(group, m);
  });
}

void Engine::Impl::accept_commands(RobotGroup& group, std::size_t member, RunHash& sum) {
  ProgramSlots& program = group.program;
  const std::size_t controllers = group.controllers.size();
  for (std::size_t c = 0; c < controllers; ++c) {
    const Command& command = program.commands[member * controllers + c];
    ControllerSlots& slots = group.controllers[c];
    // A command of another kind than the controller accepts is no command. It is not hashed either,
    // since nothing of it reaches the robot.
    if (command.kind == CommandKind::kNone || command.kind != slots.spec->accepts) continue;
    slots.last[member] = command;
    slots.last_step[member] = static_cast<std::int64_t>(step);
    ++program.given[member];
    ItemHash item(step, group.members[member].value(), HashChannel::kCommand,
                  static_cast<std::uint32_t>(c));
    item.add_bytes(std::as_bytes(std::span(&command, 1)));
    sum.add(item);
  }
  if (program.states[member] == 0) return;
  ItemHash item(step, group.members[member].value(), HashChannel::kState, 0);
  item.add(program.states[member]);
  sum.add(item);
}

void Engine::Impl::fail_program(RobotGroup& group, std::size_t member, std::string_view text,
                                std::vector<Event>& sink) {
  group.program.failed[member] = 1;
  sink.push_back({step, group.members[member], EventKind::kProgramFailed, BodyId(),
                  fmt::format("program `{}`: {}", group.program.spec->driver, text)});
}

}  // namespace rave::sim
