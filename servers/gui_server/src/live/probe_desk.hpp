// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "rave/gui_server/source.hpp"
#include "rave/plugin/catalogue.hpp"

namespace rave::gui_server {

/// What pages receive about virtual sensors, and makes probes of what they request: the sensor as
/// hosts will make it, so that the person learns at once what is wrong. The thread of the server.
class ProbeDesk {
 public:
  /// `catalogue`: of this thread alone. `step_s`: of the run.
  ProbeDesk(std::unique_ptr<plugin::Catalogue> catalogue, double step_s);

  /// The array `drivers` of a message `catalogue`. Loads all plug-ins when it is first called.
  [[nodiscard]] const std::string& catalogue_json();
  /// `robot`: in the run. Errors: those of probe::read_block() and sim::LoneSensor::make().
  [[nodiscard]] Result<ProbeMade> make(const ProbeRequest& request, std::uint32_t robot);

 private:
  std::unique_ptr<plugin::Catalogue> catalogue_;
  double step_s_;
  std::string json_;
  std::uint32_t next_;  ///< Number of the next probe, without its bits.
};

}  // namespace rave::gui_server
