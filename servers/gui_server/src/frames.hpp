// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "rave/gui_server/source.hpp"

// Binary frames of the stream; docs/explanation/gui-protocol.md describes them.
namespace rave::gui_server {

struct PoseFrameHead {
  std::uint32_t sequence = 0;
  std::uint16_t roster_revision = 0;
  bool past = false;
  bool truth = false;
};

[[nodiscard]] std::string encode_poses(const PosesAt& poses, const PoseFrameHead& head);

/// `time_s`: of the picture that the reading belongs to.
[[nodiscard]] std::string encode_reading(const ReadingAt& reading, double time_s);

}  // namespace rave::gui_server
