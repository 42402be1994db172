// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rave/bus/clock_offset.hpp"
#include "rave/doctor/finding.hpp"
#include "rave/doctor/listener.hpp"
#include "rave/doctor/probe.hpp"

namespace rave::doctor {

/// What became of the questions to the doctor of another machine.
struct ProbeResult {
  enum class PortState : std::uint8_t {
    kSilent,   ///< Nothing came back.
    kRefused,  ///< The machine is there, and nobody listens.
    kNoWay,    ///< The system knows no way there, or nobody has the address.
    kOpen,
  };
  std::string peer;  ///< Its address.
  PortState port = PortState::kSilent;
  std::string why;                            ///< kNoWay: what the system says.
  std::optional<std::uint32_t> other_domain;  ///< Where it answers instead.
  About about;                                ///< kOpen.
  std::optional<bus::ClockReading> clock;     ///< Its clock of day minus the one here.
  bool discovery_open = false;                ///< The ports of a participant there answer.
  bool data_open = false;
  std::optional<bool> multicast_there;  ///< It hears the group; nothing: not tried.
  std::optional<bool> multicast_back;   ///< What it sends to the group is heard here.
  struct Size {
    std::size_t bytes = 0;
    bool there = false;  ///< It arrived.
    bool back = false;   ///< An answer as large did.
  };
  std::vector<Size> sizes;
};

struct ProbeOptions {
  std::string address;  ///< Of the interface here, IPv4.
  std::uint32_t domain = 0;
  bool multicast = false;
  int patience_ms = 300;  ///< How long one question waits for its answer; each is asked 3 times.
  std::function<std::int64_t()> clock = clock_of_day;
};

/// Probes another machine, whatever it finds there. Sends real packets, at most 1 MB in all, and
/// takes some seconds where nobody answers.
[[nodiscard]] ProbeResult probe_peer(const std::string& peer, const ProbeOptions& options);

/// What it means. `here`: what this machine says of itself. Pure.
[[nodiscard]] Findings judge(const ProbeResult& result, const About& here);

/// Whether a process called `participant` can be seen on the bus from here, where it should be, as
/// `config` says. Joins the bus for a few seconds.
[[nodiscard]] Finding check_bus(const bus::BusConfig& config, const std::string& participant);

}  // namespace rave::doctor
