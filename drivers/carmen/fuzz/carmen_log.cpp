// SPDX-License-Identifier: Apache-2.0
// The first byte says whether a cut log is accepted, which laser is read, and whether the scans
// have a given rate; the rest is the log, packed or plain.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "carmen/log.hpp"
#include "carmen/log_text.hpp"
#include "carmen/notes.hpp"
#include "rave/base/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace rave;
  if (size == 0) return 0;
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  const auto text = recording::unpack_text(bytes, "f", std::size_t{1} << 20);
  if (!text) return 0;
  carmen::LoadOptions options;
  options.accept_cut = (data[0] & 1U) != 0;
  options.side = (data[0] & 2U) != 0 ? carmen::LaserSide::kRear : carmen::LaserSide::kFront;
  options.rate_hz = (data[0] & 4U) != 0 ? 10 : 0;
  const auto log = carmen::load_text(*text, "f", std::nullopt, options);
  if (!log) {
    RAVE_CHECK(!log.error().message.empty());
    return 0;
  }
  RAVE_CHECK(!log->scans.empty() && log->beams > 0);
  RAVE_CHECK(log->ranges_m.size() == log->scans.size() * log->beams);
  std::int64_t last_ns = log->scans.front().t_ns - 1;
  for (const carmen::Scan& scan : log->scans) {
    RAVE_CHECK(scan.t_ns > last_ns);
    RAVE_CHECK(std::abs(scan.X_WL.yaw) <= 3.15);
    for (const float range_m : log->ranges(scan)) {
      RAVE_CHECK(range_m >= 0 || std::isnan(range_m));
    }
    last_ns = scan.t_ns;
  }
  for (const std::string& note : carmen::notes(*log, "f", log->scan_report)) {
    RAVE_CHECK(!note.empty());
  }
  const auto bearings = carmen::bearings_rad(*log, 0);
  RAVE_CHECK(!bearings || bearings->size() == log->beams);
  (void)log->track().velocity(last_ns);
  return 0;
}
