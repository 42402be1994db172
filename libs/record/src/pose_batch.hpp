// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "encode.hpp"
#include "packed.hpp"
#include "stream.hpp"

namespace rave::record {

/// The poses of one step, stored in the layout of the message, so that the thread of the run only
/// copies them once more into the file's buffer.
class PoseBatch {
 public:
  Stream stream;

  void add(const RobotPose& robot);
  void add(const PoseBlock& block);
  /// Element `i` of a column with a stride of `stride_bytes`.
  template <class T>
  [[nodiscard]] static const T& at(const T* first, std::size_t stride_bytes,
                                   std::size_t i) noexcept {
    return *reinterpret_cast<const T*>(reinterpret_cast<const std::byte*>(first) +
                                       i * stride_bytes);
  }
  /// Writes one message; nothing if there are no poses.
  Status write(McapWriter& file, CdrWriter& cdr, SimTime time, std::uint64_t step);

 private:
  std::vector<PackedPose> poses_;
  std::vector<PackedTruePose> truths_;
};

}  // namespace rave::record
