// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "file_checks.hpp"
#include "rave/config/companion_file.hpp"

// The description of `companions:` in scenario files.
namespace rave::config {

constexpr auto enum_names(EnumTag<CompanionEnd> /*tag*/) {
  return std::array{EnumName{CompanionEnd::kIgnore, "ignore"},
                    EnumName{CompanionEnd::kEndRun, "end_run"}};
}

template <class V>
void describe(V& v, CompanionFile& c) {
  v.required("name", c.name, {.doc = "Name of the companion: letters, digits, - and _."});
  v.required("command", c.command,
             {.doc = "Program and arguments, without a shell. A program with a / is relative to "
                     "this file; others are searched beside rave, then in PATH. {work} is the "
                     "folder that the companions of a run share, {scenario} that of this file.",
              .min_items = 1,
              .max_items = 1000});
  v.field("environment", c.environment, {.doc = "Further variables of its environment."});
  v.field("ready", c.ready,
          {.doc = "Text that its output must contain before the run starts; null: no waiting.",
           .min_items = 1});
  v.field("ready_within_s", c.ready_within_s,
          {.doc = "Time for that; the run fails after it.",
           .min = 0,
           .exclusive_min = true,
           .max = 3600,
           .unit = "s"});
  v.field(
      "on_end", c.on_end,
      {.doc = "Reaction to its end before that of the run: report it and ignore it, or end_run, "
              "which fails the run."});
}

void validate(const CompanionFile& c, CheckContext& check);

/// Makes the paths of a companion absolute: `folder` is that of the scenario.
void expand_companion(CompanionFile& companion, const std::filesystem::path& folder);

}  // namespace rave::config
