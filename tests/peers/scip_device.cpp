// SPDX-License-Identifier: Apache-2.0
#include "scip_device.hpp"

#include <cstdlib>

namespace peer {
namespace {

std::string line(const std::string& text) {
  int sum = 0;
  for (const char c : text) sum += static_cast<unsigned char>(c);
  return text + static_cast<char>(sum % 64 + '0') + "\n";
}

/// Of VV and PP: the semicolon is not counted.
std::string info(const std::string& text) {
  const std::string summed = line(text);
  return text + ";" + summed.substr(text.size());
}

std::string code(unsigned value, int characters) {
  std::string text(static_cast<std::size_t>(characters), '0');
  for (auto digit = text.rbegin(); digit != text.rend(); ++digit, value /= 64) {
    *digit = static_cast<char>('0' + value % 64);
  }
  return text;
}

bool digits(const std::string& text, std::size_t from, std::size_t count) {
  if (text.size() < from + count) return false;
  for (std::size_t i = from; i < from + count; ++i) {
    if (text[i] < '0' || text[i] > '9') return false;
  }
  return true;
}

std::string status(const std::string& command, const std::string& text) {
  return command + "\n" + line(text) + "\n";
}

}  // namespace

void ScipDevice::power_on() {
  scip2_ = false;
  laser_on_ = false;
  streaming_.clear();
  clock_.restart();
}

std::string ScipDevice::parameters() const {
  return info("MODL:" + model_) + info("DMIN:" + std::to_string(kLeast_mm)) +
         info("DMAX:" + std::to_string(kMost_mm)) + info("ARES:" + std::to_string(kStepsPerTurn)) +
         info("AMIN:" + std::to_string(kFirstStep)) + info("AMAX:" + std::to_string(kLastStep)) +
         info("AFRT:" + std::to_string(kFrontStep)) + info("SCAN:" + std::to_string(rpm_));
}

std::string ScipDevice::answer(const std::string& command) {
  if (command.empty()) return {};
  if (command == "SCIP2.0") {
    std::string reply = scip2_ ? status(command, "0E") : command + "\n0\n\n";
    scip2_ = true;
    return reply;
  }
  if (!scip2_) return command + "\nE\n\n";
  const std::string name = command.substr(0, 2);
  if (name == "QT" || name == "RS") {
    laser_on_ = false;
    streaming_.clear();
    if (name == "RS") clock_.restart();
    return status(command, "00");
  }
  if (name == "BM") {
    std::string reply = status(command, laser_on_ ? "02" : "00");
    laser_on_ = true;
    return reply;
  }
  if (name == "VV") {
    return command + "\n" + line("00") + info("VEND:RAVE") + info("PROD:SCIP peer") +
           info("FIRM:1.0.00") + info("PROT:SCIP 2.0") + info("SERI:P0000001") + "\n";
  }
  if (name == "PP") return command + "\n" + line("00") + parameters() + "\n";
  if (name == "MD" || name == "MS" || name == "GD" || name == "GS") return measure(command);
  return status(command, "0E");
}

std::string ScipDevice::measure(const std::string& command) {
  const bool continuous = command[0] == 'M';
  if (!digits(command, 2, continuous ? 13 : 10)) return status(command, "0C");
  const int first = std::atoi(command.substr(2, 4).c_str());
  const int last = std::atoi(command.substr(6, 4).c_str());
  if (last > kLastStep || first < kFirstStep) return status(command, "04");
  if (last < first) return status(command, "05");
  if (continuous) {
    laser_on_ = true;
    streaming_ = command.substr(0, 15);
    left_ = std::atoi(command.substr(13, 2).c_str());
    skipped_ = 0;
    return status(command, "00");
  }
  if (!laser_on_ || ranges_mm_.empty()) return status(command, "10");
  return command + "\n" + line("00") + data(command);
}

std::string ScipDevice::data(const std::string& command) const {
  const int first = std::atoi(command.substr(2, 4).c_str());
  const int last = std::atoi(command.substr(6, 4).c_str());
  const int characters = command[1] == 'S' ? 2 : 3;
  std::string all;
  for (int step = first; step <= last; ++step) {
    const int mm = ranges_mm_[static_cast<std::size_t>(step - kFirstStep)];
    all += code(static_cast<unsigned>(characters == 2 && mm > 4095 ? 4095 : mm), characters);
  }
  std::string text = line(code(timer_ms_, 4));
  for (std::size_t at = 0; at < all.size(); at += 64) text += line(all.substr(at, 64));
  return text + "\n";
}

std::string ScipDevice::scanned(const std::vector<int>& ranges_mm, std::int64_t t_ns) {
  ranges_mm_ = ranges_mm;
  timer_ms_ =
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(clock_.seconds_at(t_ns) * 1000)) &
      0xffffffU;
  if (streaming_.empty()) return {};
  const int wanted_skips = streaming_[12] - '0';
  if (skipped_++ < wanted_skips) return {};
  skipped_ = 0;
  std::string echo = streaming_;
  if (left_ > 0) {
    --left_;
    echo = streaming_.substr(0, 13) + (left_ < 10 ? "0" : "") + std::to_string(left_);
    if (left_ == 0) streaming_.clear();
  }
  return echo + "\n" + line("99") + data(echo);
}

}  // namespace peer
