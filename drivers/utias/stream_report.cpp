// SPDX-License-Identifier: Apache-2.0
#include "utias/stream_report.hpp"

namespace rave::utias {

std::string_view to_string(StreamKind kind) noexcept {
  switch (kind) {
    case StreamKind::kPoses:
      return "poses";
    case StreamKind::kOdometry:
      return "odometry";
    case StreamKind::kSightings:
      return "sightings";
  }
  return "unknown";
}

}  // namespace rave::utias
