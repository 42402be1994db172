// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace rave::swarm {

/// Memory of this process that is resident, in 10^6 bytes; 0 where the system does not say.
[[nodiscard]] double resident_mb();
/// The most that was resident since the process began.
[[nodiscard]] double peak_resident_mb();

}  // namespace rave::swarm
