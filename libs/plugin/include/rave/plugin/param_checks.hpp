// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/base/result.hpp"
#include "rave/plugin/params.hpp"

namespace rave {

/// Checks that number parameter `low` is smaller than `high`, a condition that the ranges of single
/// parameters cannot express. Error kInvalidArgument names both and their values.
[[nodiscard]] inline Status check_ascending(const Params& params, const char* low,
                                            const char* high) {
  // Written so that a NaN fails as well.
  if (params.number(low) < params.number(high)) return {};
  return fail(ErrorCode::kInvalidArgument, "`{}` is {} and must be smaller than `{}`, which is {}",
              low, params.number(low), high, params.number(high));
}

}  // namespace rave
