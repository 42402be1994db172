// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/control/run_control.hpp"
#include "rave/host/run.hpp"
#include "rave/plugin/catalogue.hpp"
#include "rave/request/request.hpp"

namespace rave::runtime {

/// Options of branch().
struct BranchOptions {
  double at_s = 0;                         ///< Time of the recorded run; the step that begins then.
  std::vector<request::Request> requests;  ///< What is different from there on, in this order.
  bool with_people = false;       ///< Also what people asked in the recorded run after that time.
  std::optional<double> until_s;  ///< End of the branch; unset: that of the scenario.
  /// Output and the like of the branch. `control` is required; the run starts by itself.
  RunOptions run;
};

/// What a branch came to.
struct BranchOutcome {
  RunOutcome run;
  std::uint64_t compared = 0;  ///< Steps whose hash is that of the recording.
  /// The step before the branch whose hash differs from the recording; the run ended there.
  std::optional<std::uint64_t> differs_at;
  std::vector<std::string> refused;  ///< Requests that the run refused, and why.
};

/// Repeats a recorded run, to the bit and with what people asked, up to a time, and continues from
/// there with other parameters or obstacles. The hash of each step up to there is compared with the
/// recording. A run of several processes is repeated in this one. The recording of the branch names
/// its parent in the description of its scenario, and has the requests as those of `branch`, so
/// that verify() repeats it. Errors: those of recorded_scenario(), kInvalidArgument (a live run, a
/// recording without hashes or of one host of several, a time beyond its end).
[[nodiscard]] Result<BranchOutcome> branch(const std::filesystem::path& record,
                                           plugin::Catalogue& catalogue,
                                           const BranchOptions& options);

}  // namespace rave::runtime
