// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <map>
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

/// Puts the identity into the qualities of service of a participant, and reads it there.
void write_identity(const Identity& identity, dds_qos_t* qos);
[[nodiscard]] Identity read_identity(const dds_qos_t* qos);

/// Who else is in the domain, from the topic on which DDS tells it. Owner: the bus.
class Participants {
 public:
  /// `lease`: after which a silent process is lost.
  Participants(dds_entity_t participant, const RunId& run, Duration lease);

  /// Reads what is new. Those of this run, and those that are not of RAVE, become events; a process
  /// of another run becomes a foreign one. After this process stood still, the others have a grace
  /// in which they may come back as if they had never been missed.
  void collect(std::vector<BusEvent>& events);
  /// Who has the participant; empty if nobody known.
  [[nodiscard]] Identity find(const dds_guid_t& guid) const;
  /// Whether the participant was here and is not any more.
  [[nodiscard]] bool gone(const dds_guid_t& guid) const;
  [[nodiscard]] std::vector<BusProcess> all() const;
  [[nodiscard]] dds_entity_t reader() const noexcept { return reader_; }
  /// To be called often, and after each wait.
  [[nodiscard]] Standstill& standstill() noexcept { return standstill_; }

 private:
  using Guid = std::array<std::uint8_t, 16>;
  void appear(const dds_builtintopic_participant_t& sample, std::vector<BusEvent>& events);
  void disappear(const dds_guid_t& guid);
  void judge(std::vector<BusEvent>& events);
  [[nodiscard]] bool foreign(const Identity& who) const;

  RunId run_;
  Guid self_{};
  dds_entity_t reader_ = 0;
  Standstill standstill_;
  std::map<Guid, Identity> known_;
  /// Names stay known after their owners have gone: their endpoints are told of later.
  std::map<Guid, Identity> gone_;
  /// Seem to be gone, and nobody has been told so.
  std::map<Guid, Identity> missed_;
  bool told_ = false;  ///< Why nobody is told.
};

}  // namespace rave::bus
