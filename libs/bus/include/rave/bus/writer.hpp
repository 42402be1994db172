// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>

#include "rave/bus/bus.hpp"

namespace rave::bus {

/// What writers of all types share. Owner: a Writer.
class WriterCore {
 public:
  [[nodiscard]] static Result<WriterCore> create(Bus& bus, const TopicSpec& topic);
  WriterCore(WriterCore&& other) noexcept;
  WriterCore& operator=(WriterCore&&) = delete;
  ~WriterCore();

  [[nodiscard]] Status write(const void* sample);
  [[nodiscard]] Status dispose(const void* key);
  [[nodiscard]] std::size_t readers() const;
  [[nodiscard]] Bus& bus() const noexcept { return *bus_; }
  [[nodiscard]] dds_entity_t handle() const noexcept { return writer_; }

 private:
  WriterCore(Bus& bus, const char* topic) : bus_(&bus), topic_(topic) {}
  [[nodiscard]] bool goes_short(const void* sample);

  Bus* bus_;
  const char* topic_;
  dds_entity_t writer_ = 0;
  ShortSender* short_ = nullptr;  ///< Of the bus; null if all goes by DDS.
};

/// Writes one topic. Must be gone before its bus; thread: that of the bus.
template <class Message>
class Writer {
 public:
  /// Error: kState (the topic exists with another type), kIo.
  [[nodiscard]] static Result<Writer> create(Bus& bus) {
    RAVE_TRY_ASSIGN(WriterCore core, WriterCore::create(bus, topic_of<Message>()));
    return Writer(std::move(core));
  }

  /// Sends a sample after filling in its run and writer. Its sequences stay the caller's; they are
  /// read during the call only. Errors: kTimeout (a reader does not keep up, and there is no
  /// room for more; see QosProfile::waits), kInvalidArgument (a sequence is longer than its bound).
  [[nodiscard]] Status write(Message& sample) {
    sign(sample);
    return core_.write(&sample);
  }

  /// Says that the object named by the key fields of `sample` is no more.
  [[nodiscard]] Status dispose(Message& sample) {
    sign(sample);
    return core_.dispose(&sample);
  }

  /// How many readers are known now.
  [[nodiscard]] std::size_t readers() const { return core_.readers(); }
  /// For what this class does not do; the entity stays its own.
  [[nodiscard]] dds_entity_t handle() const noexcept { return core_.handle(); }

 private:
  explicit Writer(WriterCore core) : core_(std::move(core)) {}
  void sign(Message& sample) const {
    std::ranges::copy(core_.bus().config().run.bytes, sample.run);
    sample.writer = core_.bus().writer();
  }

  WriterCore core_;
};

}  // namespace rave::bus
