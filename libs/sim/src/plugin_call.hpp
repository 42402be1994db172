// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/robot/interface.hpp"

namespace rave::sim {

/// Runs a function of a plug-in that returns 0 or sets an ErrorText.
template <class Call>
Status called(Call&& call) {
  ErrorText error;
  if (call(&error) == 0) return {};
  return fail(ErrorCode::kPlugin, "{}", error.text);
}

}  // namespace rave::sim
