// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/line/one_sender.hpp"
#include "ros2/ros2_device.hpp"

namespace rave::ros2_driver {

/// Which of the writers of a topic, or of one transform, is that of the robot: two robots with the
/// same topics must not be taken for one. The first counts, or the one in whose process more of the
/// robot was found before. Not thread-safe.
class WriterChoice {
 public:
  struct Ruling {
    bool counts = false;
    bool changed = false;  ///< Another writer than before, whose clock may be another.
    std::string news;      ///< For users: there is a rival, or another writer counts now.
  };
  /// Judges a message that has just come to `reader`, or its transform to `frame`. Another writer
  /// takes the place of one that is gone or has been silent for `patience_s`.
  [[nodiscard]] Ruling judge(Ros2Device& device, const ros2::End& reader,
                             dds_instance_handle_t writer, double patience_s,
                             std::string_view frame = "");

 private:
  line::OneSender<dds_instance_handle_t> writers_;
  ros2::RemoteId present_;  ///< Kept, because DDS does not say which process a lost writer was of.
};

}  // namespace rave::ros2_driver
