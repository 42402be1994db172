// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/time.hpp"
#include "rave/ros2/participant.hpp"

namespace rave::ros2 {

/// A reader or writer of one topic, independent of its type. Owner: a Reader or a Writer.
class End {
 public:
  /// `topic` is an absolute name: `/cart/scan`. Errors: those of Participant::add_end().
  [[nodiscard]] static Result<End> create(const Participant& participant,
                                          const dds_topic_descriptor_t& type,
                                          std::string_view topic, const bus::QosProfile& profile,
                                          bool reads);
  End(End&& other) noexcept;
  End& operator=(End&& other) noexcept;
  ~End();

  /// Writers only. Error: kIo.
  [[nodiscard]] Status write(const void* sample) const;
  [[nodiscard]] bool wait_until_there(Duration limit) const;
  /// The matched writers of a reader, or readers of a writer.
  [[nodiscard]] std::vector<dds_instance_handle_t> matched() const;
  /// Who one of them is; nothing if it is matched no more.
  [[nodiscard]] std::optional<RemoteId> identify(dds_instance_handle_t other) const;
  /// See bus::take_mismatch().
  [[nodiscard]] std::optional<std::string> take_mismatch() const;
  /// See Participant::explain_silence().
  [[nodiscard]] std::string explain_silence() const;
  [[nodiscard]] dds_entity_t handle() const noexcept { return entity_; }
  [[nodiscard]] const std::string& topic() const noexcept { return topic_; }

 private:
  End(const Participant& participant, std::string_view type, std::string_view topic, bool reads)
      : participant_(&participant), type_(type), topic_(topic), reads_(reads) {}

  const Participant* participant_;
  std::string type_;
  std::string topic_;
  bool reads_;
  dds_entity_t entity_ = 0;
};

}  // namespace rave::ros2
