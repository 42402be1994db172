// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "arguments.hpp"
#include "console.hpp"
#include "faults.hpp"
#include "scip_device.hpp"
#include "wire.hpp"

namespace peer {

/// A ScipDevice at its end of a line, with a log of what it measured and with faults on demand.
class LaserStation {
 public:
  /// Options, each behind `prefix`: link or port, rpm, latency-ms, log.
  LaserStation(const Arguments& given, const std::string& prefix, OwnClock clock);

  /// Takes what the host has sent.
  void take(const std::string& bytes);
  /// The optics have measured.
  void scanned(const std::vector<int>& ranges_mm, Console& console, std::mt19937_64& random);
  /// `FAULT N` spoils N of the scans that follow, every other one.
  void spoil_next(Fault fault, int count);
  void set_mute(bool mute) { mute_ = mute; }
  void vanish() { wire_.vanish(); }
  /// As after power-on.
  void come_back();

  [[nodiscard]] Wire& wire() { return wire_; }
  [[nodiscard]] std::int64_t period_ns() const { return period_ns_; }

 private:
  ScipDevice device_;
  Wire wire_;
  Log log_;
  std::int64_t period_ns_;
  std::int64_t latency_ns_;
  std::string command_;
  Fault fault_ = Fault::kNone;
  int spoilt_left_ = 0;
  bool mute_ = false;
  std::int64_t count_ = 0;
};

}  // namespace peer
