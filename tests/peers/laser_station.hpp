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
  /// Options, each behind `prefix`: link or port, model, rpm, latency-ms, log.
  LaserStation(const Arguments& given, const std::string& prefix, OwnClock clock);

  /// Takes what the host has sent.
  void take(const std::string& bytes);
  /// The optics have measured.
  void scanned(std::vector<int> ranges_mm, Console& console, std::mt19937_64& random);
  /// `FAULT N` spoils N of the scans that follow, every other one.
  void spoil_next(Fault fault, int count);
  /// `blind CODE [FROM_DEG TO_DEG]`: rays measure that instead, in these directions or in all;
  /// `freeze`: each scan is like the last one, with a time of its own; `see`: as before.
  void obey(const std::vector<std::string>& command);
  void set_mute(bool mute) { mute_ = mute; }
  void vanish() { wire_.vanish(); }
  /// As after power-on.
  void come_back();

  [[nodiscard]] Wire& wire() { return wire_; }
  [[nodiscard]] std::int64_t period_ns() const { return period_ns_; }

 private:
  void deceive(std::vector<int>& ranges_mm);

  ScipDevice device_;
  Wire wire_;
  Log log_;
  std::int64_t period_ns_;
  std::int64_t latency_ns_;
  std::string command_;
  Fault fault_ = Fault::kNone;
  int spoilt_left_ = 0;
  bool mute_ = false;
  int code_ = -1;  ///< Of rays that are blind; negative: none is.
  double blind_from_deg_ = -180;
  double blind_to_deg_ = 180;
  bool frozen_ = false;
  std::vector<int> last_mm_;
  std::int64_t count_ = 0;
};

}  // namespace peer
