// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "rave/base/result.hpp"
#include "rave/base/wall_clock.hpp"
#include "rave/bus/config.hpp"
#include "rave/doctor/probe.hpp"

namespace rave::doctor {

/// The data that a process sends to doctors of other machines: its machine, version, certificates.
/// `stamp`: hash of the interfaces that hosts of a run must agree on.
[[nodiscard]] About about_here(const bus::BusConfig& config, std::uint64_t stamp);

/// The counterpart of probe_peer(): answers doctors of other machines at the doctor's port of a
/// domain, at ports that a DDS participant would have, and at the multicast group. An answer is
/// never longer than its question. One owner thread.
class Listener {
 public:
  struct Options {
    std::string address;  ///< IPv4 address of the interface.
    About about;          ///< Its ports are filled in by the listener.
    std::function<std::int64_t()> clock = wall_ns;
  };
  /// Errors: kState (another listener is running), kIo.
  [[nodiscard]] static Result<std::unique_ptr<Listener>> open(Options options);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  /// Answers until `stopping` returns true; it is called ten times a second. `heard` is called once
  /// for each machine that asks; may be empty.
  void serve(const std::function<bool()>& stopping,
             const std::function<void(const std::string&)>& heard = {});
  /// The data that it sends about this machine.
  [[nodiscard]] const About& about() const noexcept;

 private:
  struct Impl;
  explicit Listener(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::doctor
