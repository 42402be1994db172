// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::cli {

/// Prints what this build is and which plug-ins fit it. Returns 0.
[[nodiscard]] int version();

}  // namespace rave::cli
