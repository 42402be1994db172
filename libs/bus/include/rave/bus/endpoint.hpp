// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

/// What readers and writers of DDS have in common, whoever made them: those of the bus and those of
/// ROS 2. Thread: that of the entity's owner.
namespace rave::bus {

/// Samples in the memory of Cyclone DDS, until they are given back.
struct Loan {
  static constexpr std::size_t kBatch = 8;
  std::array<void*, kBatch> samples{};
  std::array<dds_sample_info_t, kBatch> infos;
  std::size_t size = 0;
};

/// Up to Loan::kBatch samples that have come; none after an error. give_back() before the next
/// call.
void take(dds_entity_t reader, Loan& loan);
void give_back(dds_entity_t reader, Loan& loan) noexcept;

/// How many are at the other ends of a reader or writer.
[[nodiscard]] std::size_t matched_ends(dds_entity_t entity, bool reads) noexcept;

/// What to tell a user if somebody who wants the same topic with other qualities of service has
/// come since the last call: which policy does not match, and how to mend it.
[[nodiscard]] std::optional<std::string> take_mismatch(dds_entity_t entity, bool reads);

}  // namespace rave::bus
