// SPDX-License-Identifier: Apache-2.0
#include "commands/schema.hpp"

#include <array>

#include "error_text.hpp"
#include "rave/base/names.hpp"
#include "rave/base/result.hpp"
#include "rave/config/experiment_file.hpp"
#include "rave/config/scenario_file.hpp"

namespace rave::cli {

Result<int> schema(const SchemaCommand& options) {
  if (options.kind == "robot") return put(stdout, config::robot_schema()), kGood;
  if (options.kind == "world") return put(stdout, config::world_schema()), kGood;
  if (options.kind == "scenario") return put(stdout, config::scenario_schema()), kGood;
  if (options.kind == "experiment") return put(stdout, config::experiment_schema()), kGood;
  constexpr std::array<std::string_view, 4> kKinds = {"robot", "world", "scenario", "experiment"};
  return fail(ErrorCode::kNotFound, "there is no kind of file `{}`{}", options.kind,
              suggestion(options.kind, kKinds));
}

}  // namespace rave::cli
