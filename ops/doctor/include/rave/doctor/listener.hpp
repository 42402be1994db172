// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "rave/base/result.hpp"
#include "rave/bus/config.hpp"
#include "rave/doctor/probe.hpp"

namespace rave::doctor {

/// The clock of day, nanoseconds since 1970.
[[nodiscard]] std::int64_t clock_of_day();

/// What a process says of itself to doctors of other machines: its machine, version, certificates.
/// `stamp`: of the interfaces that hosts of a run must agree on.
[[nodiscard]] About about_here(const bus::BusConfig& config, std::uint64_t stamp);

/// The other side of probe_peer(): answers doctors of other machines at the doctor's port of a
/// domain, at ports that a participant of DDS would have, and at the multicast group. An answer is
/// never longer than its question. One owner thread.
class Listener {
 public:
  struct Options {
    std::string address;  ///< Of the interface, IPv4.
    About about;          ///< The ports in it are filled in.
    std::function<std::int64_t()> clock = clock_of_day;
  };
  /// Errors: kState (another one listens), kIo.
  [[nodiscard]] static Result<std::unique_ptr<Listener>> open(Options options);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

  /// Answers until `stopping`, which is asked ten times a second, says so. `heard` is told of each
  /// machine that asks, once; may be empty.
  void serve(const std::function<bool()>& stopping,
             const std::function<void(const std::string&)>& heard = {});
  /// What it says of itself.
  [[nodiscard]] const About& about() const noexcept;

 private:
  struct Impl;
  explicit Listener(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace rave::doctor
