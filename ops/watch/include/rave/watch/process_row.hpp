// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "rave/watch/run_model.hpp"
#include "rave/watch/run_view.hpp"

namespace rave::runtime {
struct RunStatus;
}  // namespace rave::runtime

namespace rave::watch {

/// The row of a run of one process in a list of hosts. Such a run is not on the bus, so it is known
/// through its status, and through /proc of this machine. One owner thread.
class ProcessRow {
 public:
  /// `name`: of the row. `process`: id of the process; of one that does not exist, or does not run
  /// here, the processor and the memory stay unknown. Reads /proc.
  [[nodiscard]] HostView row(std::string name, std::uint32_t process,
                             const runtime::RunStatus& status);

 private:
  Rate cpu_;
};

}  // namespace rave::watch
