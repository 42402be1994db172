// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "recording/samples.hpp"
#include "utias/folder.hpp"
#include "utias/recording_names.hpp"
#include "utias/samples.hpp"
#include "utias/stream_report.hpp"
#include "utias/subjects.hpp"

namespace rave::utias {

/// The formats of the logs.
[[nodiscard]] std::span<const Column> pose_columns() noexcept;
[[nodiscard]] std::span<const Column> odometry_columns() noexcept;
[[nodiscard]] std::span<const Column> sighting_columns() noexcept;
[[nodiscard]] std::span<const Column> barcode_columns() noexcept;
[[nodiscard]] std::span<const Column> landmark_columns() noexcept;

using recording::StreamWindow;

template <class Sample>
struct Stream {
  std::vector<Sample> samples;
  StreamReport report;
};

/// Sorts, removes duplicates, wraps headings, cuts to the window with its margin, and reports it.
[[nodiscard]] Stream<PoseSample> make_poses(LogFile file, int robot, const StreamWindow& window);
[[nodiscard]] Stream<OdometrySample> make_odometry(LogFile file, int robot,
                                                   const StreamWindow& window);
/// Likewise for sightings: equal stamps are kept, the offset is added to the stamps, and there is
/// no margin.
[[nodiscard]] Stream<Sighting> make_sightings(LogFile file, int robot, const StreamWindow& window,
                                              std::int64_t clock_offset_ns, CodeMeaning meaning,
                                              const Subjects& subjects);

}  // namespace rave::utias
