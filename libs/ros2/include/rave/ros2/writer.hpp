// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "rave/ros2/end.hpp"
#include "rave/ros2/messages.hpp"

namespace rave::ros2 {

/// Writes one topic of ROS 2. Must be gone before its participant. One thread at a time.
template <class Message>
class Writer {
 public:
  /// `topic` is whole: `/cart/cmd_vel`. Errors: those of Participant::add_end().
  [[nodiscard]] static Result<Writer> create(const Participant& participant, std::string_view topic,
                                             const bus::QosProfile& profile = kWrite) {
    RAVE_TRY_ASSIGN(End end,
                    End::create(participant, descriptor_of<Message>(), topic, profile, false));
    return Writer(std::move(end));
  }

  /// Sends a sample; its texts and sequences stay the caller's and are read during the call only.
  /// Null texts count as empty. Error: kIo.
  [[nodiscard]] Status write(const Message& sample) { return end_.write(&sample); }
  /// Waits until all readers that want everything have it; false: they had it not in time.
  [[nodiscard]] bool wait_until_there(Duration limit) const { return end_.wait_until_there(limit); }
  /// How many readers are known now.
  [[nodiscard]] std::size_t readers() const { return end_.matched(); }
  /// As of bus::take_mismatch().
  [[nodiscard]] std::optional<std::string> take_mismatch() { return end_.take_mismatch(); }
  /// As of Participant::explain_silence().
  [[nodiscard]] std::string explain_silence() const { return end_.explain_silence(); }
  [[nodiscard]] const std::string& topic() const noexcept { return end_.topic(); }

 private:
  explicit Writer(End end) : end_(std::move(end)) {}

  End end_;
};

}  // namespace rave::ros2
