// SPDX-License-Identifier: Apache-2.0
#include "rave/base/check.hpp"

#include <cstdio>
#include <cstdlib>

namespace rave::detail {

void check_failed(const char* condition, const char* file, int line) noexcept {
  std::fprintf(stderr, "%s:%d: internal error in RAVE: %s\n", file, line, condition);
  std::abort();
}

}  // namespace rave::detail
