// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <memory>
#include <string_view>

namespace rave::bus {

/// How a topic is delivered. Writers and readers of a topic use the same profile.
struct QosProfile {
  bool reliable = true;
  /// A late reader is given what its writers have kept, and objects outlive a writer that ends.
  bool durable = false;
  /// How many samples are kept per instance, at both ends; 0: all, up to `max_samples`.
  std::int32_t depth = 1;
  /// 0: no limit but `depth`.
  std::int32_t max_samples = 0;
  /// Where readers have not confirmed `max_samples`, or 16 MB, a writer waits for them up to half a
  /// second; otherwise not at all. What has no room then is dropped, and the writer is told.
  bool waits = false;
};

/// The newest of each instance, resent until it is there.
inline constexpr QosProfile kNewest{};
/// The newest of each instance, also for those who come later.
inline constexpr QosProfile kDurable{.durable = true, .waits = true};
/// The same from those who have no time to wait, and say again what did not get through.
inline constexpr QosProfile kDescription{.durable = true};
/// The last of what happened at each, also for those who come later. Waits for nobody.
inline constexpr QosProfile kPast{.durable = true, .depth = 256};
/// The last few of each instance: what is left out of one is in another one.
inline constexpr QosProfile kLately{.depth = 8};
/// Everything, in order. A writer waits when 4096 samples are not confirmed, and then fails.
inline constexpr QosProfile kEverything{.depth = 0, .max_samples = 4096, .waits = true};
/// The last few of each instance: bursts get through, a stuck reader holds nobody up.
inline constexpr QosProfile kRecent{.depth = 256};
/// The same where the robots of a whole host send through one writer at once: of what a stuck
/// reader has not confirmed, the oldest beyond this are lost.
inline constexpr QosProfile kCrowd{.depth = 16'384};
/// Sent once; late or lost means useless.
inline constexpr QosProfile kOnce{.reliable = false};

struct QosDeleter {
  void operator()(dds_qos_t* qos) const noexcept { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

/// The profile in the terms of DDS, for a topic, writer or reader.
[[nodiscard]] Qos make_qos(const QosProfile& profile);

/// The name of a policy of DDS by its number, and what a user can do if two ends disagree on it.
struct PolicyAdvice {
  std::string_view name;
  std::string_view remedy;
};
[[nodiscard]] PolicyAdvice advice_for_policy(std::uint32_t policy_id) noexcept;

}  // namespace rave::bus
