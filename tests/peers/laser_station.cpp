// SPDX-License-Identifier: Apache-2.0
#include "laser_station.hpp"

#include <cmath>
#include <cstdlib>

namespace peer {

LaserStation::LaserStation(const Arguments& given, const std::string& prefix, OwnClock clock)
    : device_(given.text(prefix + "model", "PEER-04LX"),
              static_cast<int>(given.number(prefix + "rpm", 600)), clock),
      wire_(given.text(prefix + "link", ""), static_cast<int>(given.number(prefix + "port", 0)),
            !given.has(prefix + "link")),
      log_(given.text(prefix + "log", "")),
      period_ns_(std::llround(60e9 / given.number(prefix + "rpm", 600))),
      latency_ns_(std::llround(given.number(prefix + "latency-ms", 0) * 1e6)) {}

void LaserStation::take(const std::string& bytes) {
  for (const char byte : bytes) {
    if (byte != '\n' && byte != '\r') {
      if (command_.size() < 64) command_ += byte;
      continue;
    }
    if (command_.substr(0, 2) == "QT" || command_.substr(0, 2) == "RS") wire_.flush();
    wire_.send(device_.answer(command_), 0);
    command_.clear();
  }
}

void LaserStation::obey(const std::vector<std::string>& command) {
  const auto degrees = [&](std::size_t i, double otherwise) {
    return command.size() > i ? std::atof(command[i].c_str()) : otherwise;
  };
  if (command[0] == "see") code_ = -1;
  if (command[0] == "see") frozen_ = false;
  if (command[0] == "freeze") frozen_ = true;
  if (command[0] != "blind" || command.size() < 2) return;
  code_ = std::atoi(command[1].c_str());
  blind_from_deg_ = degrees(2, -180);
  blind_to_deg_ = degrees(3, 180);
}

/// What the optics give instead of what is there.
void LaserStation::deceive(std::vector<int>& ranges_mm) {
  if (frozen_ && !last_mm_.empty()) ranges_mm = last_mm_;
  for (std::size_t i = 0; code_ >= 0 && i < ranges_mm.size(); ++i) {
    const double step = static_cast<double>(i) + ScipDevice::kFirstStep - ScipDevice::kFrontStep;
    const double deg = 360 * step / ScipDevice::kStepsPerTurn;
    if (deg >= blind_from_deg_ && deg <= blind_to_deg_) ranges_mm[i] = code_;
  }
  last_mm_ = ranges_mm;
}

void LaserStation::scanned(std::vector<int> ranges_mm, Console& console, std::mt19937_64& random) {
  deceive(ranges_mm);
  const std::int64_t measured_ns = true_ns();
  const std::string bytes = device_.scanned(ranges_mm, measured_ns);
  // With polling the answers are sent elsewhere; what they hold is logged all the same.
  // Every other one, so that there are good ones to find between the bad.
  const bool spoilt = !bytes.empty() && spoilt_left_ > 0 && count_ % 2 == 0;
  const Fault fault = spoilt ? fault_ : Fault::kNone;
  std::string entry = std::to_string(++count_) + " " + std::to_string(measured_ns) + " " +
                      std::to_string(device_.timer_ms()) + " " + to_string(fault);
  for (const int mm : ranges_mm) entry += " " + std::to_string(mm);
  log_.write(entry);
  if (bytes.empty() || mute_) return;
  std::int64_t at = measured_ns + latency_ns_;
  for (const Chunk& chunk : spoil(bytes, fault, random)) {
    at += chunk.pause_ns;
    wire_.send(chunk.bytes, at);
  }
  if (fault != Fault::kNone && --spoilt_left_ == 0) console.say("spoilt");
}

void LaserStation::spoil_next(Fault fault, int count) {
  fault_ = fault;
  spoilt_left_ = count;
}

void LaserStation::come_back() {
  command_.clear();
  device_.power_on();
  wire_.come_back();
}

}  // namespace peer
