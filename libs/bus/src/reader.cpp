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

void ReaderCore::take(Loan& loan) {
  // Null pointers ask Cyclone for memory of its own.
  loan.samples.fill(nullptr);
  const dds_return_t count =
      dds_take(reader_, loan.samples.data(), loan.infos.data(), kBatch, std::uint32_t{kBatch});
  loan.size = count > 0 ? static_cast<std::size_t>(count) : 0;
}

void ReaderCore::give_back(Loan& loan) noexcept {
  if (loan.size > 0) {
    dds_return_loan(reader_, loan.samples.data(), static_cast<std::int32_t>(loan.size));
  }
  loan.size = 0;
}

void ReaderCore::refuse(std::uint64_t writer, std::string why) {
  bus_->note_refused(topic_, writer, std::move(why));
}

std::size_t ReaderCore::writers() const {
  const dds_return_t count = dds_get_matched_publications(reader_, nullptr, 0);
  return count < 0 ? 0 : static_cast<std::size_t>(count);
}

}  // namespace rave::bus
