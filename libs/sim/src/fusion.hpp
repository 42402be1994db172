// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "instances.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/range_engine.hpp"

namespace rave::sim {

/// What makes one sensor of a type a hybrid, for all robots of it. Vectors are indexed by member
/// (times capacity for records); after creation none changes its size.
struct FusionSlots {
  InstanceArray driver;    ///< What fuses; one for all.
  InstanceArray imagined;  ///< The driver of the virtual half; one for all.
  bool uses_fan = false;
  FanTable fan;
  std::uint32_t capacity = 0;         ///< Of the virtual half.
  std::uint32_t real_stride = 0;      ///< Bytes of all records of one member.
  std::uint32_t imagined_stride = 0;  ///< Likewise.
  std::optional<Processing> real_noise;
  std::optional<Processing> imagined_noise;

  std::vector<SampleHeader> real_headers;
  std::vector<std::byte> real_records;
  std::vector<SampleHeader> imagined_headers;
  std::vector<std::byte> imagined_records;
  std::vector<std::uint32_t> bodies;     ///< Fans: what each virtual reading met.
  std::vector<std::byte> state;          ///< Of the virtual half's driver.
  std::vector<std::uint8_t> failed;      ///< No more readings.
  std::vector<std::uint32_t> withheld;   ///< Records since the last reading that was let through.
  std::vector<std::uint64_t> too_late;   ///< Withheld: the history is too short.
  std::vector<std::int64_t> last_stamp;  ///< Of the last reading; -1: none.

  /// Makes both drivers and checks that the halves fit: `real` is what the real half declared.
  /// Errors: whatever a driver says, naming it; kInvalidArgument if the halves do not fit.
  [[nodiscard]] static Result<std::unique_ptr<FusionSlots>> make(const SensorSpec& spec,
                                                                 const SensorInfo& real,
                                                                 std::uint32_t members,
                                                                 HostServices host);
  /// As make() left it.
  void clear();
  [[nodiscard]] SensorParts parts_of(std::size_t member) const noexcept;
  [[nodiscard]] std::byte* real_records_of(std::size_t member) noexcept {
    return real_records.data() + std::size_t{real_stride} * member;
  }
  [[nodiscard]] std::byte* imagined_records_of(std::size_t member) noexcept {
    return imagined_records.data() + std::size_t{imagined_stride} * member;
  }
};

}  // namespace rave::sim
