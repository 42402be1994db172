// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "rave/ros2/end.hpp"
#include "rave/ros2/messages.hpp"

namespace rave::ros2 {

/// Writes one topic of ROS 2. Destroy it before its participant. One thread at a time.
template <class Message>
class Writer {
 public:
  /// `topic` is an absolute name: `/cart/cmd_vel`. Errors: those of Participant::add_end().
  [[nodiscard]] static Result<Writer> create(const Participant& participant, std::string_view topic,
                                             const bus::QosProfile& profile = kWrite) {
    RAVE_TRY_ASSIGN(End end,
                    End::create(participant, descriptor_of<Message>(), topic, profile, false));
    return Writer(std::move(end));
  }

  /// Sends a sample. Its texts and sequences stay owned by the caller and are read during the call
  /// only. Null texts count as empty. Error: kIo.
  [[nodiscard]] Status write(const Message& sample) { return end_.write(&sample); }
  /// Waits until all reliable readers have acknowledged the samples; false: not within `limit`.
  [[nodiscard]] bool wait_until_there(Duration limit) const { return end_.wait_until_there(limit); }
  /// For questions about its readers.
  [[nodiscard]] const End& end() const noexcept { return end_; }
  /// See bus::take_mismatch().
  [[nodiscard]] std::optional<std::string> take_mismatch() { return end_.take_mismatch(); }
  /// See Participant::explain_silence().
  [[nodiscard]] std::string explain_silence() const { return end_.explain_silence(); }
  [[nodiscard]] const std::string& topic() const noexcept { return end_.topic(); }

 private:
  explicit Writer(End end) : end_(std::move(end)) {}

  End end_;
};

}  // namespace rave::ros2
