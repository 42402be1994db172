// SPDX-License-Identifier: Apache-2.0
#include "create_oi/create_options.hpp"

#include "rave/math/scalar.hpp"

namespace rave::oi {

Result<DeviceOptions> read_options(const Params& params) {
  DeviceOptions options;
  RAVE_TRY_ASSIGN(options.address, line::read_address(params));
  options.mode = params.text("mode") == "full" ? Mode::kFull : Mode::kSafe;
  options.geometry.wheel_base_m = params.number("wheel_base_m");
  options.geometry.counts_per_m =
      params.number("counts_per_turn") / (kPi * params.number("wheel_diameter_m"));
  options.geometry.max_wheel_mps = params.number("max_wheel_mps");
  options.refresh_s = params.number("refresh_s");
  options.timing = line::read_timing(params);
  return options;
}

}  // namespace rave::oi
