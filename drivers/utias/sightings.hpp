// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rave::utias {

/// No subject has this number.
inline constexpr int kUnknownSubject = 0;

/// One barcode seen by a robot's camera. Nanoseconds from the origin.
struct Sighting {
  std::int64_t t_ns = 0;
  /// The number in the log: a barcode, in spite of the log's header.
  int code = 0;
  /// The subject with this code (robots 1 to 5, landmarks 6 to 20), or kUnknownSubject.
  int subject = kUnknownSubject;
  /// Distance from the robot's centre to the centre of the subject, metres.
  double range_m = 0;
  /// Direction relative to the robot's heading, counter-clockwise, radians.
  double bearing_rad = 0;
};

/// The sightings of one robot in order of time; those of one stamp in file order. Immutable; may be
/// read from any thread.
class SightingLog {
 public:
  SightingLog() = default;
  /// `sightings`: ascending in time (precondition).
  explicit SightingLog(std::vector<Sighting> sightings);

  [[nodiscard]] std::span<const Sighting> all() const noexcept { return sightings_; }

  /// Sightings with one stamp come from one image and form a group.
  [[nodiscard]] std::size_t group_count() const noexcept { return group_begins_.size(); }
  /// `index` < group_count(); never empty.
  [[nodiscard]] std::span<const Sighting> group(std::size_t index) const noexcept;

 private:
  std::vector<Sighting> sightings_;
  std::vector<std::size_t> group_begins_;
};

}  // namespace rave::utias
