// SPDX-License-Identifier: Apache-2.0
#include "rave/base/control_characters.hpp"
#include "rave/base/plain_name.hpp"
#include "scenario_fields.hpp"

namespace rave::codec {

using config::Pace;
using config::RunLength;

void Codec<Pace>::read(const ReadContext& context, const RawNode& node, Pace& value) {
  const auto text = node.as_text();
  const auto pace = text ? config::parse_pace(*text) : Result<Pace>(Pace{});
  if (text && pace) {
    value = *pace;
  } else {
    context.wrong(node, expectation(context.options));
  }
}

RawNode Codec<Pace>::schema(const FieldOptions& /*options*/) {
  return RawNode::mapping({{"type", RawNode::text("string")},
                           {"pattern", RawNode::text("^(max|realtime|[0-9][0-9.e+-]*x)$")}});
}

std::string Codec<Pace>::expectation(const FieldOptions& /*options*/) {
  return "`max`, `realtime` or a positive number followed by `x`, such as `10x`";
}

namespace {

constexpr std::string_view kNoEnd = "none";

}  // namespace

void Codec<RunLength>::read(const ReadContext& context, const RawNode& node, RunLength& value) {
  if (node.is_text() && node.scalar() == kNoEnd) {
    value = kOpenEnd_s;
  } else if (node.as_double()) {
    Codec<double>::read(context, node, value.seconds);
  } else {
    context.wrong(node, expectation(context.options));
  }
}

RawNode Codec<RunLength>::write(const RunLength& value) {
  return value.is_open() ? RawNode::text(std::string(kNoEnd)) : RawNode::number(value);
}

RawNode Codec<RunLength>::schema(const FieldOptions& options) {
  RawNode choices = RawNode::sequence();
  choices.push_back(Codec<double>::schema(options));
  choices.push_back(RawNode::mapping({{"const", RawNode::text(std::string(kNoEnd))}}));
  return RawNode::mapping({{"anyOf", std::move(choices)}});
}

std::string Codec<RunLength>::expectation(const FieldOptions& options) {
  return Codec<double>::expectation(options) + ", or `none`";
}

}  // namespace rave::codec

namespace rave::config {

void validate(const ScatterFile& c, CheckContext& check) {
  for (const auto& [key, range] : {std::pair("x_m", c.x_m), std::pair("y_m", c.y_m)}) {
    if (range[0] <= range[1]) continue;
    check.error(key, "`{}`: found {} to {}, expected the first not to be greater", key, range[0],
                range[1]);
  }
}

void validate(const RobotEntry& c, CheckContext& check) {
  check_name("name", *c.name, check);
  if (!c.part_of.empty()) check_name("part_of", c.part_of, check);
  if (c.kind) check_name("kind", *c.kind, check);
  if (!c.file && !c.robot) {
    check.error("", "the robot `{}` has neither `file` nor `robot`", *c.name);
  }
  const int starts = int{c.pose.has_value()} + int{c.poses.has_value()} + int{c.grid.has_value()} +
                     int{c.ring.has_value()} + int{c.scatter.has_value()};
  if (starts > 1) {
    check.error("",
                "the robot `{}` has more than one of `pose`, `poses`, `grid`, `ring` and `scatter`",
                *c.name);
  }
  const bool has_twin = c.twin || c.twin_robot;
  // Each twin may be a device of its own, so one file cannot stand for several.
  if (has_twin && starts > 0 && !c.pose && !c.real) {
    check.error("twin", "`twin` needs a single robot, but `{}` stands for several", *c.name);
  }
  if (c.real && !has_twin) check.error("real", "`real` needs `twin`, the file of the real robot");
  if (c.shadow && !has_twin) {
    check.error("shadow", "`shadow` needs `twin`, the file of the simulated robot");
  }
}

void validate(const GuiRightFile& c, CheckContext& check) {
  if (c.role.has_value() == c.user.has_value()) {
    check.error("", "expected exactly one of `role` and `user`");
  }
  // No account can have another name, and a reader could take it for that of an account.
  if (c.user && !is_user_name(c.user->value)) {
    check.error("user", "`user`: found `{}`, expected {}",
                without_control_characters(c.user->value, "?"), kUserNameRule);
  }
  if ((c.reach == GuiReach::kTeams) == c.teams.empty()) {
    check.error("teams", "`teams` is required with `reach: teams` and not allowed without it");
  }
}

void validate(const GuiComponentFile& c, CheckContext& check) {
  const std::string& module = *c.module;
  if (!module.ends_with(".js") && !module.ends_with(".mjs")) {
    check.error("module", "`module`: found `{}`, expected a file that ends in .js or .mjs", module);
  }
}

void validate(const GuiFile& c, CheckContext& check) {
  if (!c.file) return;
  const std::pair<const char*, bool> others[] = {
      {"rights", !c.rights.empty()}, {"relay", c.relay}, {"components", !c.components.empty()}};
  for (const auto& [key, present] : others) {
    if (present) check.error(key, "`{}`: expected in `{}`, which `file` names", key, **c.file);
  }
}

namespace {

void check_trigger(const ChangeFile& c, CheckContext& check) {
  const int triggers = int{c.at_s.has_value()} + int{c.when.has_value()} +
                       int{c.every_s.has_value()} + int{c.after.has_value()};
  if (triggers != 1) {
    check.error(triggers == 0 ? "" : "at_s",
                "expected exactly one of `at_s`, `when`, `every_s` and `after`, found {}",
                triggers);
    return;
  }
  if (c.every_s && **c.every_s <= 0) check.error("every_s", "`every_s`: expected more than 0");
  if (*c.delay_s > 0 && !c.when && !c.after) {
    check.error("delay_s", "`delay_s` belongs to `when` or `after`");
  }
  if (c.repeat && !c.when) check.error("repeat", "`repeat` belongs to `when`");
  if (c.hand_over && !c.at_s) {
    check.error("hand_over", "`hand_over` needs `at_s`: conditions cannot hand robots over yet");
  }
}

}  // namespace

void validate(const ChangeFile& c, CheckContext& check) {
  check_trigger(c, check);
  const int kinds = int{c.robot || c.set || c.hand_over} + int{c.request.has_value()} +
                    int{c.end.has_value()} + int{c.give.has_value()} + parts_of(c.obstacle) +
                    int{c.mark.has_value() && !c.end};
  // One kind per entry, since the order of entries is the order of the changes.
  if (kinds != 1) {
    check.error("",
                "expected exactly one change per entry, found {}: `robot` with `set` or "
                "`hand_over`, `add_obstacle`, `move_obstacle`, `remove_obstacle`, `request`, "
                "`give`, `mark` or `end`",
                kinds);
    return;
  }
  if (c.hand_over) {
    if (!c.robot) check.error("hand_over", "`hand_over` needs `robot`");
    if (c.set) check.error("set", "`set` and `hand_over` are two changes; write two entries");
    return;
  }
  if (!c.robot && !c.set) return;
  if (!c.robot) check.error("set", "`set` needs `robot`");
  if (c.set && c.set->is_mapping() && c.set->size() > 0) return;
  check.error(c.set ? "set" : "robot",
              "`set`: found {}, expected keys such as `program.speed_mps` with new values",
              c.set ? c.set->found_text() : "nothing");
}

void validate(const HostFile& c, CheckContext& check) { check_name("name", *c.name, check); }

void validate(const ScenarioFile& c, CheckContext& check) {
  check_name("name", *c.name, check);
  check_unique("host", c.hosts, check);
  check_unique("companion", c.companions, check);
  check_unique("user", c.users, check);
  check_unique("team", c.teams, check);
  if (c.processes && !c.hosts.empty()) {
    check.error("processes", "expected `processes` or `hosts`, not both");
  }
  check_unique("obstacle", c.obstacles, check);
  if (c.picture && c.picture->instant_s && *c.picture->instant_s > c.duration_s) {
    check.error("picture", "`instant_s`: found {}, expected at most `duration_s` ({})",
                *c.picture->instant_s, c.duration_s.seconds);
  }
}

// Robots written into a scenario have variables like those in files. They are replaced before the
// scenario is read, because `$(v)` is no number.
void prepare_robots(RawNode& scenario, Diagnostics& diagnostics) {
  split_entries(scenario, diagnostics);
  RawNode* robots = scenario.find("robots");
  if (!robots || !robots->is_sequence()) return;
  for (std::size_t i = 0; i < robots->size(); ++i) {
    RawNode& entry = robots->child(i);
    Variables given;
    if (const RawNode* values = entry.find("variables"); values && values->is_mapping()) {
      for (std::size_t k = 0; k < values->size(); ++k) given[values->key(k)] = values->child(k);
    }
    for (const std::string_view key : {"robot", "twin_robot"}) {
      RawNode* const robot = entry.find(key);
      if (robot) substitute_variables(*robot, given, diagnostics);
    }
  }
}

void validate(const TouchesCheckFile& c, CheckContext& check) {
  if (c.least <= c.most) return;
  check.error("least", "`least`: found {}, expected at most `most` ({})", c.least, c.most);
}

}  // namespace rave::config
