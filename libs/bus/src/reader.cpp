// SPDX-License-Identifier: Apache-2.0
#include "rave/bus/reader.hpp"

namespace rave::bus {

Result<ReaderCore> ReaderCore::create(Bus& bus, const TopicSpec& topic) {
  ReaderCore core(bus, topic.name);
  RAVE_TRY_ASSIGN(core.reader_, bus.add_endpoint(topic, true));
  return core;
}

ReaderCore::ReaderCore(ReaderCore&& other) noexcept
    : bus_(other.bus_), topic_(other.topic_), reader_(std::exchange(other.reader_, 0)) {}

ReaderCore::~ReaderCore() {
  if (reader_ > 0) bus_->remove_endpoint(reader_);
}

void ReaderCore::refuse(std::uint64_t writer, std::string why) {
  bus_->note_refused(topic_, writer, std::move(why));
}

std::size_t ReaderCore::writers() const { return matched_ends(reader_, true); }

}  // namespace rave::bus
