// SPDX-License-Identifier: Apache-2.0
#include "rave/request/order.hpp"

namespace rave::request {

Status check_path_size(std::size_t points) {
  if (points >= 2 && points <= kMostOrderPoints) return {};
  return fail(ErrorCode::kInvalidArgument, "a path has {} point{}; expected 2 to {}", points,
              points == 1 ? "" : "s", kMostOrderPoints);
}

}  // namespace rave::request
