// SPDX-License-Identifier: Apache-2.0
// The first byte chooses the format and the policy; the rest is the log, packed or plain.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "rave/base/check.hpp"
#include "utias/recording_names.hpp"
#include "utias/streams.hpp"

namespace {

using namespace rave::utias;

std::span<const Column> columns_for(unsigned choice) {
  switch (choice % 5) {
    case 0:
      return pose_columns();
    case 1:
      return odometry_columns();
    case 2:
      return sighting_columns();
    case 3:
      return barcode_columns();
    default:
      return landmark_columns();
  }
}

void check_streams(const ParsedLog& log, unsigned choice) {
  const StreamWindow window{1'000'000'000, 0, 200'000'000'000, 1'000'000'000};
  LogFile file;
  file.log = log;
  if (choice % 5 == 0) {
    const PoseTrack track(make_poses(file, 1, window).samples);
    (void)track.velocity(100'000'000'000);
  } else if (choice % 5 == 1) {
    (void)make_odometry(file, 1, window);
  } else if (choice % 5 == 2) {
    const auto sightings = make_sightings(file, 1, window, 0, CodeMeaning::kBarcode, {}).samples;
    RAVE_CHECK(std::ranges::is_sorted(sightings, {}, &Sighting::t_ns));
  } else {
    (void)Subjects::join(log.rows, "b", log.rows, "l", {});
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const unsigned choice = data[0];
  const std::string_view bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  (void)parse_stretch(bytes, "s");
  const auto text = unpack_text(bytes, "f", std::size_t{1} << 20);
  if (!text) return 0;
  const auto log = parse_log(*text, "f", columns_for(choice & 0x3fU), (choice & 0x80U) != 0);
  if (!log) {
    RAVE_CHECK(!log.error().message.empty() && log.error().where.line > 0);
    return 0;
  }
  for (const auto& row : log->rows) {
    RAVE_CHECK(row.stamp_ns >= 0 && row.stamp_ns <= kLatestStamp_ns);
    for (const double value : row.reals) RAVE_CHECK(std::abs(value) <= 1e6);
  }
  check_streams(*log, choice & 0x3fU);
  return 0;
}
