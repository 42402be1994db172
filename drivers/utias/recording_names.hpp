// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "recording/pose_track.hpp"
#include "recording/stamp.hpp"
#include "recording/stream_report.hpp"
#include "recording/stretch.hpp"
#include "recording/unpack.hpp"

// Names of the common recording library in this namespace.
namespace rave::utias {

using recording::Gap;
using recording::GapKind;
using recording::kLatestStamp_ns;
using recording::parse_stamp_ns;
using recording::parse_stretch;
using recording::PoseSample;
using recording::PoseTrack;
using recording::Repair;
using recording::RepairKind;
using recording::sha256_hex;
using recording::Stretch;
using recording::unpack_text;
using recording::UnpackedText;

}  // namespace rave::utias
