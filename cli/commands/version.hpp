// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::cli {

/// Prints the version and the interfaces that plug-ins must match. Returns 0.
[[nodiscard]] int version();

}  // namespace rave::cli
