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

/// The identity that a process announces with its participant, before any sample.
struct Identity {
  std::string name;
  RunId run;  ///< None: not a process of RAVE, for example a ROS 2 robot.
  std::uint64_t writer = 0;
};

/// Writes the identity into the QoS of a participant, writer or reader, and reads it back.
void write_identity(const Identity& identity, dds_qos_t* qos);
[[nodiscard]] Identity read_identity(const dds_qos_t* qos);

/// The reader and the writer of the signs of life of processes. Cyclone DDS keeps the lease of the
/// writers by itself; the samples only show that a process that had fallen silent is back.
struct LifeSignEnds {
  dds_entity_t reader = 0;
  dds_entity_t writer = 0;   ///< 0: this process is anonymous, others do not see it.
  std::uint64_t number = 0;  ///< The writer id of this process.
};

/// The other processes in the domain, from the built-in topics of DDS and, of this run, from their
/// signs of life. Owner: the bus.
///
/// Announcements of participants are not encrypted, even with certificates. So with them a
/// process announces its identity through a writer, which only members receive: its participant
/// first appears without a name, and again with it when that writer is known.
class Participants {
 public:
  Participants(dds_entity_t participant, const LifeSignEnds& sign, const BusConfig& config);

  /// Says that this process lives, once in a lease. Call it often.
  void beat();
  /// Reads the changes. Processes of this run, and those not of RAVE, become events; of another run
  /// only the first process does. After a standstill of this process, others have a grace period in
  /// which they can be found again without an event.
  void collect(std::vector<BusEvent>& events);
  /// The identity of a participant; empty if unknown.
  [[nodiscard]] Identity find(const dds_guid_t& guid) const;
  /// Whether the participant was known and has left.
  [[nodiscard]] bool gone(const dds_guid_t& guid) const;
  [[nodiscard]] std::vector<BusProcess> all() const;
  /// Whether the participant may use the writer id: it is the first in the run that claimed it, or
  /// no participant has.
  [[nodiscard]] bool speaks_for(const dds_guid_t& guid, std::uint64_t writer) const;
  /// The first participant of the run that claims the id; null if there is none.
  [[nodiscard]] const dds_guid_t* owner_of(std::uint64_t writer) const;
  /// How often a process has fallen silent or come back without that DDS forgot it; its readers and
  /// writers still match those of others, but gone() says that they do not count.
  [[nodiscard]] std::uint64_t silences() const noexcept { return silences_; }
  /// The participants that have come back after a silence since the last call.
  [[nodiscard]] std::vector<dds_guid_t> take_returned() { return std::exchange(returned_, {}); }
  /// The readers whose samples indicate a change.
  [[nodiscard]] const std::vector<dds_entity_t>& readers() const noexcept { return readers_; }
  /// One of them, whose status indicates a change, too.
  [[nodiscard]] dds_entity_t life_signs() const noexcept { return life_sign_.reader; }
  /// See Standstill::look(): call it often, and after each wait.
  [[nodiscard]] Standstill& standstill() noexcept { return standstill_; }

 private:
  using Guid = std::array<std::uint8_t, 16>;
  void appear(const dds_builtintopic_participant_t& sample, std::vector<BusEvent>& events);
  void disappear(const dds_guid_t& guid);
  /// A known participant has announced its identity.
  void learn(const Guid& key, const Identity& who, std::vector<BusEvent>& events);
  /// The identities announced through writers since the last call.
  [[nodiscard]] std::map<Guid, Identity> take_writers() const;
  void take_life_signs(std::vector<BusEvent>& events);
  /// A writer of signs of life has fallen silent. If it has sent none, DDS does not say which one.
  void suspect_the_new();
  void fall_silent(std::uint64_t writer);
  void come_back(std::uint64_t writer, std::vector<BusEvent>& events);
  void judge(std::vector<BusEvent>& events);
  /// Whether it belongs to a run that this process looks at.
  [[nodiscard]] bool ours(const Identity& who) const { return all_runs_ || who.run == run_; }
  [[nodiscard]] bool foreign(const Identity& who) const;

  RunId run_;
  bool all_runs_;
  bool secured_;
  Duration lease_;
  Guid self_{};
  LifeSignEnds life_sign_;
  Standstill::Clock::time_point last_beat_{};
  /// Of participants, of signs of life, and with `secured_` also of writers.
  std::vector<dds_entity_t> readers_;
  Standstill standstill_;
  std::map<Guid, Identity> known_;
  std::map<std::uint64_t, dds_guid_t> owners_;  ///< Participants of this run, by writer id.
  std::set<std::string> foreign_told_;          ///< Runs already reported, by number.
  /// Identities of participants that have left; events of their endpoints follow later.
  std::map<Guid, Identity> gone_;
  /// Those of `gone_` that DDS still knows, as they may come back.
  std::set<Guid> silent_;
  std::uint64_t silences_ = 0;
  std::vector<dds_guid_t> returned_;
  std::set<std::uint64_t> heard_;  ///< Writer ids of processes whose signs of life have arrived.
  /// Apparently lost, not reported yet.
  std::map<Guid, Identity> missed_;
  bool told_ = false;  ///< A standstill was reported.
};

}  // namespace rave::bus
