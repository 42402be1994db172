// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

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

/// A row of the "Odometry" log, which holds the *commanded* velocity. Nanoseconds from the origin.
struct OdometrySample {
  std::int64_t t_ns = 0;
  double v_mps = 0;
  double w_radps = 0;
};

}  // namespace rave::utias
