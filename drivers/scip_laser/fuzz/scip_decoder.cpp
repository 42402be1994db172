// SPDX-License-Identifier: Apache-2.0
// The first byte chooses the request that scans are read by; the rest is what a device sends.
#include "scip_laser/scip_decoder.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "rave/base/check.hpp"
#include "scip_laser/scip_code.hpp"
#include "scip_laser/scip_parameters.hpp"
#include "scip_laser/scip_scan.hpp"

namespace {

using namespace rave::scip;

void check_reply(const Reply& reply, const ScanRequest& request, Scan& scan) {
  for (const std::string_view line : reply.lines) RAVE_CHECK(!line.empty());
  if (reply.echo == "PP") {
    const auto parameters = parse_parameters(reply.lines);
    if (parameters) {
      RAVE_CHECK(parameters->first_step <= parameters->last_step);
      RAVE_CHECK(std::abs(parameters->bearing_rad(parameters->last_step)) < 3.15);
      RAVE_CHECK(parameters->scan_period_s() > 0);
    }
  }
  const ScanEnd end = read_scan(reply, request, scan);
  if (end == ScanEnd::kRefused) RAVE_CHECK(!describe_status(reply.status).empty());
  if (end != ScanEnd::kScan) return;
  RAVE_CHECK(scan.timer_ms < (1U << 24) && scan.ranges_m.size() == request.size());
  for (const float range_m : scan.ranges_m) {
    RAVE_CHECK(std::isinf(range_m) || std::isnan(range_m) ||
               (range_m > 0.019F && range_m < 5.601F));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  ScanRequest request;
  request.continuous = (data[0] & 1U) == 0;
  request.characters = (data[0] & 2U) == 0 ? 3 : 2;
  request.codes = (data[0] & 4U) == 0 ? ErrorCodes::kReasons : ErrorCodes::kDistances;
  request.last_step = 31;
  request.range_min_mm = 20;
  request.range_max_mm = 5600;
  ScipDecoder decoder;
  UnwrappedTime time;
  Scan scan;
  for (std::size_t i = 1; i < size; ++i) {
    const Reply* reply = decoder.push(static_cast<char>(data[i]));
    if (reply == nullptr) continue;
    check_reply(*reply, request, scan);
    RAVE_CHECK(time.seconds(scan.timer_ms) >= 0);
  }
  return 0;
}
