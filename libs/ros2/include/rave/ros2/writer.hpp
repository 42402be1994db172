// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "rave/base/time.hpp"
#include "rave/bus/endpoint.hpp"
#include "rave/ros2/messages.hpp"
#include "rave/ros2/participant.hpp"

namespace rave::ros2 {

/// What writers of all types share. Owner: a Writer.
class WriterCore {
 public:
  [[nodiscard]] static Result<WriterCore> create(const Participant& participant,
                                                 const dds_topic_descriptor_t& type,
                                                 std::string_view topic,
                                                 const bus::QosProfile& profile);
  WriterCore(WriterCore&& other) noexcept;
  WriterCore& operator=(WriterCore&& other) noexcept;
  ~WriterCore();

  [[nodiscard]] Status write(const void* sample);
  [[nodiscard]] bool wait_until_there(Duration limit) const;
  [[nodiscard]] dds_entity_t handle() const noexcept { return writer_; }
  [[nodiscard]] const std::string& topic() const noexcept { return topic_; }
  [[nodiscard]] std::string explain_silence() const;

 private:
  WriterCore(const Participant& participant, std::string_view type, std::string_view topic)
      : participant_(&participant), type_(type), topic_(topic) {}

  const Participant* participant_;
  std::string type_;
  std::string topic_;
  dds_entity_t writer_ = 0;
};

/// Writes one topic of ROS 2. Must be gone before its participant. One thread at a time.
template <class Message>
class Writer {
 public:
  /// `topic` is whole: `/cart/cmd_vel`. Errors: those of Participant::add_end().
  [[nodiscard]] static Result<Writer> create(const Participant& participant, std::string_view topic,
                                             const bus::QosProfile& profile = kWrite) {
    RAVE_TRY_ASSIGN(WriterCore core,
                    WriterCore::create(participant, descriptor_of<Message>(), topic, profile));
    return Writer(std::move(core));
  }

  /// Sends a sample; its texts and sequences stay the caller's and are read during the call only.
  /// Null texts count as empty. Error: kIo.
  [[nodiscard]] Status write(const Message& sample) { return core_.write(&sample); }
  /// Waits until all readers that want everything have it; false: they had it not in time.
  [[nodiscard]] bool wait_until_there(Duration limit) const {
    return core_.wait_until_there(limit);
  }
  /// How many readers are known now.
  [[nodiscard]] std::size_t readers() const { return bus::matched_ends(core_.handle(), false); }
  /// As of bus::take_mismatch().
  [[nodiscard]] std::optional<std::string> take_mismatch() {
    return bus::take_mismatch(core_.handle(), false);
  }
  /// As of Participant::explain_silence().
  [[nodiscard]] std::string explain_silence() const { return core_.explain_silence(); }
  [[nodiscard]] const std::string& topic() const noexcept { return core_.topic(); }

 private:
  explicit Writer(WriterCore core) : core_(std::move(core)) {}

  WriterCore core_;
};

}  // namespace rave::ros2
