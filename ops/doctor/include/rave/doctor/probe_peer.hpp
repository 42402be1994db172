// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rave/base/wall_clock.hpp"
#include "rave/bus/clock_offset.hpp"
#include "rave/doctor/finding.hpp"
#include "rave/doctor/listener.hpp"
#include "rave/doctor/probe.hpp"

namespace rave::doctor {

/// The result of probing the doctor of another machine.
struct ProbeResult {
  enum class PortState : std::uint8_t {
    kSilent,   ///< No answer.
    kRefused,  ///< The machine answers, but no process listens.
    kNoWay,    ///< No route, or no machine has the address.
    kOpen,
  };
  std::string peer;  ///< Its address.
  PortState port = PortState::kSilent;
  std::string why;                            ///< kNoWay: the message of the system.
  std::optional<std::uint32_t> other_domain;  ///< The domain in which it answers instead.
  About about;                                ///< kOpen.
  /// Offset of its system clock: its clock minus the local one.
  std::optional<bus::ClockReading> clock;
  bool discovery_open = false;  ///< The ports of a participant there answer.
  bool data_open = false;
  std::optional<bool> multicast_there;  ///< It receives the multicast group; empty: not tested.
  /// Its multicast packets are received here; empty: not tested.
  std::optional<bool> multicast_back;
  struct Size {
    std::size_t bytes = 0;
    bool there = false;  ///< A packet of this size arrived.
    bool back = false;   ///< An answer of this size arrived.
  };
  std::vector<Size> sizes;
};

struct ProbeOptions {
  std::string address;  ///< IPv4 address of the local interface.
  std::uint32_t domain = 0;
  bool multicast = false;
  int patience_ms = 300;  ///< Timeout for the answer to one question; each is asked 3 times.
  std::function<std::int64_t()> clock = wall_ns;
};

/// Probes another machine and collects all results, whatever fails. Sends real packets, at most 1
/// MB in all, and takes some seconds if there is no answer.
[[nodiscard]] ProbeResult probe_peer(const std::string& peer, const ProbeOptions& options);

/// The findings that follow from a result. `here`: the data of this machine. Pure.
[[nodiscard]] Findings judge(const ProbeResult& result, const About& here);

/// Whether the participant `participant` can be discovered on the bus from here with `config`.
/// Joins the bus for a few seconds.
[[nodiscard]] Finding check_bus(const bus::BusConfig& config, const std::string& participant);

}  // namespace rave::doctor
