// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "line_json.hpp"
#include "rave/control/run_control.hpp"

// The state of a run, as an answer has it.
namespace rave::control {

[[nodiscard]] Json status_json(const runtime::RunStatus& status);
/// False: a member is missing or has the wrong type. What older processes do not say may be
/// missing.
[[nodiscard]] bool read_status(const Json& json, runtime::RunStatus& status);
/// Members of an object; false: it is missing or has the wrong type.
[[nodiscard]] bool read_bool(const Json& json, const char* key, bool& value);
[[nodiscard]] bool read_text(const Json& json, const char* key, std::string& value);

}  // namespace rave::control
