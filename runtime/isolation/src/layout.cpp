// SPDX-License-Identifier: Apache-2.0
#include "layout.hpp"

namespace rave::isolation {
namespace {

/// Assigns parts of the memory, each aligned to a cache line.
class Allocator {
 public:
  std::size_t take(std::size_t bytes) {
    constexpr std::size_t kLine = 64;
    const std::size_t at = end_;
    end_ += (bytes + kLine - 1) / kLine * kLine;
    return at;
  }
  [[nodiscard]] std::size_t end() const { return end_; }

 private:
  std::size_t end_ = 0;
};

}  // namespace

// Host and child compute the layout separately from the same setup, so no offset of the child is
// ever used by the host.
Layout make_layout(std::size_t setup_bytes, std::span<const SensorInfo> sensors,
                   std::span<const CommunicatorInfo> communicators, std::size_t command_count) {
  Layout layout;
  Allocator memory;
  memory.take(sizeof(SharedHead));
  layout.setup = memory.take(setup_bytes);
  layout.decide = memory.take(sizeof(SharedDecide));
  for (const SensorInfo& info : sensors) {
    Layout::Sensor sensor;
    sensor.capacity = info.capacity;
    sensor.record_bytes = record_size(info.kind);
    sensor.header = memory.take(sizeof(SampleHeader));
    sensor.records = memory.take(std::size_t{sensor.capacity} * sensor.record_bytes);
    layout.sensors.push_back(sensor);
  }
  const auto take_box = [&memory](const CommunicatorInfo& info) {
    Layout::Box box;
    box.max_messages = info.max_messages;
    box.max_bytes = info.max_bytes;
    box.max_message_bytes = info.max_message_bytes;
    box.state = memory.take(sizeof(SharedMailbox));
    box.heads = memory.take(std::size_t{info.max_messages} * sizeof(rave::MessageHead));
    box.data = memory.take(info.max_bytes);
    return box;
  };
  for (const CommunicatorInfo& info : communicators) {
    Layout::Communicator communicator;
    communicator.in = take_box(info);
    communicator.out = take_box(info);
    layout.communicators.push_back(communicator);
  }
  layout.orders = memory.take(sizeof(SharedOrders) + kOrderBytes);
  layout.answers = memory.take(sizeof(SharedAnswers) + kAnswerBytes);
  layout.state = memory.take(sizeof(std::uint64_t));
  layout.command_count = command_count;
  layout.commands = memory.take(command_count * sizeof(Command));
  layout.total_bytes = memory.end();
  return layout;
}

}  // namespace rave::isolation
