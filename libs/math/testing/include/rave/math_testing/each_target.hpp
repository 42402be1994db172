// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <hwy/targets.h>

#include <cstdint>

namespace rave {

/// Calls `test(name)` once with each set of vector instructions that this processor has, the scalar
/// one among them, then lets the processor's best be chosen again. Returns how many there were.
template <class Test>
int for_each_target(const Test& test) {
  const std::int64_t all = hwy::SupportedTargets();
  int count = 0;
  for (std::int64_t rest = all; rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().DeInit();
    test(hwy::TargetName(rest & -rest));
    ++count;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  return count;
}

}  // namespace rave
