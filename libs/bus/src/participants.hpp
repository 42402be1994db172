// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "rave/bus/bus.hpp"
#include "rave/bus/event.hpp"
#include "rave/bus/run_id.hpp"
#include "rave/bus/standstill.hpp"

namespace rave::bus {

/// What a process says of itself with its participant, before anything else is exchanged.
struct Identity {
  std::string name;
  RunId run;  ///< None: no process of RAVE, for example a ROS 2 robot.
  std::uint64_t writer = 0;
};

/// Puts the identity into the qualities of service of a participant, writer or reader, and reads it
/// there.
void write_identity(const Identity& identity, dds_qos_t* qos);
[[nodiscard]] Identity read_identity(const dds_qos_t* qos);

/// Who else is in the domain, from the topics on which DDS tells it. Owner: the bus.
///
/// What a participant says of itself is sent unencrypted, with certificates too. So with `secured`
/// a process says who it is with a writer, of which only members are told: its participant appears
/// without a name, and again with it as soon as that writer is known.
class Participants {
 public:
  /// `lease`: after which a silent process is lost.
  Participants(dds_entity_t participant, const RunId& run, Duration lease, bool secured);

  /// Reads what is new. Those of this run, and those that are not of RAVE, become events; of
  /// another run the first process that is seen becomes one. After this process stood still, the
  /// others have a grace in which they may come back as if they had never been missed.
  void collect(std::vector<BusEvent>& events);
  /// Who has the participant; empty if nobody known.
  [[nodiscard]] Identity find(const dds_guid_t& guid) const;
  /// Whether the participant was here and is not any more.
  [[nodiscard]] bool gone(const dds_guid_t& guid) const;
  [[nodiscard]] std::vector<BusProcess> all() const;
  /// Whether the participant may speak as `writer`: of those in the run that say they are `writer`
  /// it was the first, or there is none.
  [[nodiscard]] bool speaks_for(const dds_guid_t& guid, std::uint64_t writer) const;
  /// The first participant of the run that says it is `writer`; null if there is none.
  [[nodiscard]] const dds_guid_t* owner_of(std::uint64_t writer) const;
  /// Whose samples say that something may have changed.
  [[nodiscard]] const std::vector<dds_entity_t>& readers() const noexcept { return readers_; }
  /// To be called often, and after each wait.
  [[nodiscard]] Standstill& standstill() noexcept { return standstill_; }

 private:
  using Guid = std::array<std::uint8_t, 16>;
  void appear(const dds_builtintopic_participant_t& sample, std::vector<BusEvent>& events);
  void disappear(const dds_guid_t& guid);
  /// A known participant has said who it is.
  void learn(const Guid& key, const Identity& who, std::vector<BusEvent>& events);
  /// Who has said so with a writer since the last call.
  [[nodiscard]] std::map<Guid, Identity> take_writers() const;
  void judge(std::vector<BusEvent>& events);
  [[nodiscard]] bool foreign(const Identity& who) const;

  RunId run_;
  bool secured_;
  Duration lease_;
  Guid self_{};
  std::vector<dds_entity_t> readers_;  ///< Of participants, and with `secured_` of writers.
  Standstill standstill_;
  std::map<Guid, Identity> known_;
  std::map<std::uint64_t, dds_guid_t> owners_;  ///< Of this run, by writer.
  std::set<std::string> foreign_told_;          ///< Runs, by their numbers.
  /// Names stay known after their owners have gone: their endpoints are told of later.
  std::map<Guid, Identity> gone_;
  /// Seem to be gone, and nobody has been told so.
  std::map<Guid, Identity> missed_;
  bool told_ = false;  ///< Why nobody is told.
};

}  // namespace rave::bus
