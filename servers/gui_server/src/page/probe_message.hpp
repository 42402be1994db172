// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "page/members.hpp"
#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

inline constexpr std::size_t kMostProbes = 4;

/// The virtual sensors that a page tries at present: instead of those of before.
struct LookProbesMessage {
  std::uint32_t request = 0;
  std::vector<ProbeRequest> probes;  ///< At most kMostProbes.
};

/// A page wants to know which virtual sensors there are.
struct AskCatalogueMessage {
  std::uint32_t request = 0;
};

/// The message `look_probes`. Names have letters, digits, - and _ alone, numbers are finite.
/// Errors: kParse with what was expected.
[[nodiscard]] Result<LookProbesMessage> look_probes_of(Members& members);

}  // namespace rave::gui_server
