// SPDX-License-Identifier: Apache-2.0
#include "input_notes.hpp"

#include "parameters.hpp"

namespace rave::sim {

Event noted_input(std::uint64_t step, RobotId robot, EventKind kind, std::string text,
                  Author author, RunHash& hash) {
  if (author == Author::kHand) text += text.empty() ? "by hand" : " (by hand)";
  ItemHash item(step, robot.value(), HashChannel::kInput, static_cast<std::uint32_t>(kind));
  item.add_bytes(std::as_bytes(std::span(text)));
  hash.add(item);
  return {step, robot, kind, BodyId(), std::move(text)};
}

Status check_body_change(const ParameterChange& change) {
  const ParameterChange* const one[] = {&change};
  const auto checked = with_changes(body_params(), {}, one);
  if (!checked) return tl::unexpected(checked.error());
  return {};
}

std::string body_change_text(double scale_before, double scale_after) {
  return fmt::format("body.scale: {} -> {}", scale_before, scale_after);
}

tl::unexpected<Error> refused_change(const EngineSpec& spec, RobotId robot, std::string_view part,
                                     const Error& error) {
  Error named = error;
  named.message =
      fmt::format("robot `{}`, {}: {}", spec.robots[robot.value()].name, part, error.message);
  return tl::unexpected(std::move(named));
}

}  // namespace rave::sim
