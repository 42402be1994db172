// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What all DDS readers and writers share, both those of the bus and those of ROS 2. Thread: that
/// of the entity's owner.
namespace rave::bus {

/// Samples in memory of Cyclone DDS, until give_back().
struct Loan {
  static constexpr std::size_t kBatch = 8;
  std::array<void*, kBatch> samples{};
  std::array<dds_sample_info_t, kBatch> infos;
  std::size_t size = 0;
};

/// Takes up to Loan::kBatch samples; none after an error. Call give_back() before the next take().
void take(dds_entity_t reader, Loan& loan);
/// The same, but they stay in the reader as samples that have been read.
void read_new(dds_entity_t reader, Loan& loan);
void give_back(dds_entity_t reader, Loan& loan) noexcept;

/// The entities that currently match a reader or writer.
[[nodiscard]] std::vector<dds_instance_handle_t> matched(dds_entity_t entity, bool reads);
/// The participant of one of them; all zero if it has left.
[[nodiscard]] dds_guid_t participant_of(dds_entity_t entity, bool reads,
                                        dds_instance_handle_t handle);
/// The number of matched entities of a reader or writer.
[[nodiscard]] std::size_t matched_ends(dds_entity_t entity, bool reads) noexcept;

/// A message for users if an entity with incompatible QoS has appeared on the topic since the last
/// call: which policy is incompatible, and how to correct it. Empty if there is none.
/// `all_partitions`: false: an entity in another partition is none.
[[nodiscard]] std::optional<std::string> take_mismatch(dds_entity_t entity, bool reads,
                                                       bool all_partitions = true);

}  // namespace rave::bus
