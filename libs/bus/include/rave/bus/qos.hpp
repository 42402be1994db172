// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <string_view>

namespace rave::bus {

/// The quality of service of a topic. Its writers and readers use the same profile.
struct QosProfile {
  bool reliable = true;
  /// Whether a late reader receives the samples that writers keep, and objects outlive their
  /// writer.
  bool durable = false;
  /// How many samples each end keeps per instance.
  std::int32_t depth = 1;
  /// Whether a write blocks, for up to half a second, while 16 MB are not acknowledged. If there is
  /// still no room, the sample is dropped and the write fails.
  bool waits = false;
  /// Whether a reader keeps the newest sample of each instance, and hands those of a process out
  /// again when that one is back after a silence. A process that forgets what silent ones said
  /// needs it: DDS repeats a durable sample only to readers that it takes for new.
  bool recalls = false;
};

/// Reliable; keeps the newest sample of each instance.
inline constexpr QosProfile kNewest{};
/// Reliable and durable; keeps the newest sample of each instance. Writers may block.
inline constexpr QosProfile kDurable{.durable = true, .waits = true};
/// Like kDurable, for what a process is known by to the others.
inline constexpr QosProfile kIntroduction{.durable = true, .waits = true, .recalls = true};
/// Like kDurable, for writers that must not block. They repeat what was not delivered.
inline constexpr QosProfile kDescription{.durable = true};
/// Like kDescription, for what a process says of its robots.
inline constexpr QosProfile kRoster{.durable = true, .recalls = true};
/// Reliable and durable; keeps the last 256 samples of each instance. Writers do not block.
inline constexpr QosProfile kPast{.durable = true, .depth = 256};
/// Reliable; keeps the last 8 samples of each instance. What one instance lost is in another.
inline constexpr QosProfile kLately{.depth = 8};
/// Reliable; keeps the last 256 samples of each instance. Bursts are delivered; a stuck reader
/// blocks no sender.
inline constexpr QosProfile kRecent{.depth = 256};
/// Like kRecent, for one writer that serves all robots of a host. If a reader is stuck, the oldest
/// samples beyond this depth are lost.
inline constexpr QosProfile kCrowd{.depth = 16'384};
/// Best effort: sent once, because a late sample is useless.
inline constexpr QosProfile kOnce{.reliable = false};

struct QosDeleter {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

/// The DDS QoS object of a profile, for a topic, writer or reader.
[[nodiscard]] Qos make_qos(const QosProfile& profile);

/// The name of a DDS policy, and what a user can do if two ends disagree on it.
struct PolicyAdvice {
  std::string_view name;
  std::string_view remedy;
};
[[nodiscard]] PolicyAdvice advice_for_policy(std::uint32_t policy_id) noexcept;

}  // namespace rave::bus
