// SPDX-License-Identifier: Apache-2.0
// What arrives by DDS or by the local transport, attributed to its sender.
#include "rave/bus/reader.hpp"

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include "rave/bus/local_transport.hpp"

namespace rave::bus {

Result<ReaderCore> ReaderCore::create(Bus& bus, const TopicSpec& topic) {
  ReaderCore core;
  RAVE_TRY_ASSIGN(const Bus::Endpoint* const endpoint, core.add(bus, topic, true));
  core.local_ = endpoint->receiver.get();
  if (!endpoint->recalls) return core;
  core.recalled_ = topic.type;
  // Ends with the reader.
  core.news_ = dds_create_readcondition(
      core.entity_, DDS_NOT_READ_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ANY_INSTANCE_STATE);
  if (core.news_ < 0) return fail(ErrorCode::kIo, "{}: {}", topic.name, dds_strretcode(core.news_));
  return core;
}

void ReaderCore::recall(const Visit& visit) {
  if (recalled_ == nullptr) return;
  Bus::Endpoint& endpoint = *bus_->endpoint(entity_);
  // DDS would look at every sample that is kept, and a step must not cost that.
  if (!has_news() && endpoint.returned.empty()) return;
  // Nothing may come twice while its writer is there, so what a process said is kept as long.
  constexpr std::uint32_t kOfTheGone = DDS_READ_SAMPLE_STATE | DDS_ANY_VIEW_STATE |
                                       DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE |
                                       DDS_NOT_ALIVE_NO_WRITERS_INSTANCE_STATE;
  Loan loan;
  do {
    loan.samples.fill(nullptr);
    const dds_return_t count = dds_take_mask(entity_, loan.samples.data(), loan.infos.data(),
                                             Loan::kBatch, std::uint32_t{Loan::kBatch}, kOfTheGone);
    loan.size = count > 0 ? static_cast<std::size_t>(count) : 0;
    give_back(entity_, loan);
  } while (loan.size == Loan::kBatch);
  const auto returned = std::exchange(endpoint.returned, {});
  if (returned.empty()) return;
  read_all_again([&](const void* sample, const dds_sample_info_t& info) {
    const dds_guid_t from = participant_of(entity_, true, info.publication_handle);
    if (std::ranges::any_of(
            returned, [&](const dds_guid_t& guid) { return std::ranges::equal(guid.v, from.v); })) {
      visit(sample, info);
    }
  });
}

void ReaderCore::read_all_again(const Visit& visit) const {
  std::vector<void*> samples;
  std::vector<dds_sample_info_t> infos;
  std::size_t count = 0;
  // DDS begins with the first one at each call, so there must be room for all of them. They are
  // copies: Cyclone DDS 0.10 lends a reader's memory in one size only.
  for (std::size_t room = 64; count >= samples.size(); room *= 4) {
    while (samples.size() < room) samples.push_back(dds_alloc(recalled_->m_size));
    infos.resize(room);
    const dds_return_t read =
        dds_read_mask(entity_, samples.data(), infos.data(), room, static_cast<std::uint32_t>(room),
                      DDS_READ_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
    if (read <= 0) break;
    count = static_cast<std::size_t>(read);
  }
  for (std::size_t i = 0; i < count; ++i) visit(samples[i], infos[i]);
  for (void* const sample : samples) dds_sample_free(sample, recalled_, DDS_FREE_ALL);
}

void ReaderCore::next(Loan& loan) {
  if (recalled_ == nullptr) return take(entity_, loan);
  loan.size = 0;
  if (has_news()) read_new(entity_, loan);
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
