// SPDX-License-Identifier: Apache-2.0
#include "scip_laser/laser_options.hpp"

#include <algorithm>

namespace rave::scip {

Result<LaserOptions> read_options(const Params& params) {
  LaserOptions options;
  RAVE_TRY_ASSIGN(options.address, line::read_address(params));
  options.continuous = params.text("mode") != "polled";
  options.characters = params.text("characters") == "two" ? 2 : 3;
  options.first_step = static_cast<std::int32_t>(params.integer("first_step"));
  options.last_step = static_cast<std::int32_t>(params.integer("last_step"));
  options.skip_scans = static_cast<std::int32_t>(params.integer("skip_scans"));
  options.timing = line::read_timing(params);
  return options;
}

Result<ScanRequest> request_for(const LaserOptions& options, const Parameters& device) {
  ScanRequest request;
  request.continuous = options.continuous;
  request.characters = options.characters;
  request.first_step = options.first_step < 0 ? device.first_step : options.first_step;
  request.last_step = options.last_step < 0 ? device.last_step : options.last_step;
  request.skipped_scans = options.skip_scans;
  request.codes = error_codes_of(device.model);
  request.range_min_mm = device.range_min_mm;
  request.range_max_mm =
      // Two characters have 12 bits. The largest number, 4095, means "that far or farther", so 4094
      // mm is the longest range.
      options.characters == 2 ? std::min(device.range_max_mm, 4094) : device.range_max_mm;
  if (request.first_step < device.first_step || request.last_step > device.last_step ||
      request.first_step > request.last_step) {
    return fail(ErrorCode::kInvalidArgument,
                "`first_step` {} and `last_step` {} do not lie within the device's {} to {}",
                request.first_step, request.last_step, device.first_step, device.last_step);
  }
  return request;
}

}  // namespace rave::scip
