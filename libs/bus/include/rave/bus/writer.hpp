// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "rave/bus/bus.hpp"
#include "rave/bus/endpoint_owner.hpp"

namespace rave::bus {

/// The part of Writer that does not depend on the message type. Owner: a Writer.
class WriterCore : public EndpointOwner {
 public:
  [[nodiscard]] static Result<WriterCore> create(Bus& bus, const TopicSpec& topic);

  [[nodiscard]] Status write(const void* sample);
  [[nodiscard]] Status dispose(const void* key);
  [[nodiscard]] std::size_t readers() const;
  [[nodiscard]] Status await_arrival(Duration patience) {
    return bus_->await_arrival(entity_, patience);
  }

 private:
  [[nodiscard]] bool goes_locally(const void* sample);

  LocalSender* local_ = nullptr;  ///< Owned by the bus; null: all samples use DDS.
};

/// Writes one topic. Destroy it before its bus; thread: that of the bus.
template <class Message>
class Writer {
 public:
  /// Not open: it has no readers, and only open() may be called.
  Writer() = default;
  /// Creates a writer. Errors: kState (the topic exists with another type), kIo.
  [[nodiscard]] static Result<Writer> create(Bus& bus) {
    Writer writer;
    RAVE_TRY(writer.open(bus));
    return writer;
  }
  /// The same for a member; see open_all().
  [[nodiscard]] Status open(Bus& bus) {
    RAVE_TRY_ASSIGN(core_, WriterCore::create(bus, topic_of<Message>()));
    return {};
  }

  /// Sets the writer of a sample, and its run if the bus has one, and sends it. Its sequences stay
  /// owned by the caller and are read during the call only. Errors: kTimeout (a reader does not
  /// keep up and there is no room; see QosProfile::waits), kInvalidArgument (a sequence is longer
  /// than its bound).
  [[nodiscard]] Status write(Message& sample) {
    sign(sample);
    return core_.write(&sample);
  }

  /// Announces that the object with the key fields of `sample` no longer exists.
  [[nodiscard]] Status dispose(Message& sample) {
    sign(sample);
    return core_.dispose(&sample);
  }

  /// Waits until all present readers have what was written. Errors: kTimeout, kState (all readers
  /// were lost meanwhile), kIo.
  [[nodiscard]] Status await_arrival(Duration patience) { return core_.await_arrival(patience); }
  /// The number of matched readers.
  [[nodiscard]] std::size_t readers() const { return core_.readers(); }
  /// The DDS writer, for what this class does not offer. Still owned by this object.
  [[nodiscard]] dds_entity_t handle() const noexcept { return core_.handle(); }

 private:
  void sign(Message& sample) const {
    const BusConfig& config = core_.bus().config();
    if (!config.all_runs) std::ranges::copy(config.run.bytes, sample.run);
    sample.writer = core_.bus().writer();
  }

  WriterCore core_;
};

}  // namespace rave::bus
