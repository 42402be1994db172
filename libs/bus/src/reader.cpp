// SPDX-License-Identifier: Apache-2.0
// What arrives by DDS or by the local transport, attributed to its sender.
#include "rave/bus/reader.hpp"

#include <cstring>

#include "rave/bus/local_transport.hpp"

namespace rave::bus {

Result<ReaderCore> ReaderCore::create(Bus& bus, const TopicSpec& topic) {
  ReaderCore core;
  RAVE_TRY_ASSIGN(const Bus::Endpoint* const endpoint, core.add(bus, topic, true));
  core.local_ = endpoint->receiver.get();
  return core;
}

std::size_t ReaderCore::begin_take() {
  return local_ == nullptr ? 0 : local_->begin_take(kMostAtOnce);
}

bool ReaderCore::leaves_dds(bool got) { return local_ != nullptr && local_->leaves_dds(got); }

const void* ReaderCore::take_local(std::size_t& budget) {
  // A budget, so that a peer that sends without end cannot keep this process from its other work.
  for (; budget > 0; --budget) {
    auto datagram = local_->receive();
    if (!datagram) return nullptr;
    if (datagram->writer == 0 && local_->may_meet()) {
      // The writer may have matched after the last check.
      bus_->meet(*bus_->endpoint(entity_));
      datagram->writer = local_->sender();
    }
    if (datagram->writer == 0) {
      bus_->note_stranger();
      continue;
    }
    // The sample lies in the memory of the decoder until the next one.
    if (const void* const sample = local_->decoder().decode(datagram->bytes)) {
      --budget;
      sender_ = datagram->writer;
      return sample;
    }
    refuse(datagram->writer, "a datagram of the local transport is not a sample of this topic");
  }
  return nullptr;
}

bool ReaderCore::is_of(std::uint64_t writer, const dds_sample_info_t& info) {
  // Only samples of the local transport have no handle.
  const bool known = info.publication_handle == 0
                         ? writer == sender_
                         : bus_->speaks_for(entity_, info.publication_handle, writer);
  if (!known) refuse(writer, "another process sent it in the name of this process");
  return known;
}

void ReaderCore::refuse(std::uint64_t writer, std::string why) {
  bus_->note_refused(topic_, writer, std::move(why));
}

std::size_t ReaderCore::writers() const { return matched_ends(entity_, true); }

}  // namespace rave::bus
