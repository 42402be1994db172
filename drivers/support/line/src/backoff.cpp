// SPDX-License-Identifier: Apache-2.0
#include "rave/line/backoff.hpp"

#include <algorithm>

namespace rave::line {

Backoff::Wait Backoff::next() noexcept {
  const Wait now = wait_;
  wait_ = std::min(2 * wait_, kLongest);
  return now;
}

}  // namespace rave::line
