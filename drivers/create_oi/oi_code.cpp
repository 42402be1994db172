// SPDX-License-Identifier: Apache-2.0
#include "create_oi/oi_code.hpp"

#include <algorithm>
#include <array>

namespace rave::oi {
namespace {

enum Opcode : std::uint8_t {
  kStart = 128,
  kSafe = 131,
  kFull = 132,
  kDriveDirect = 145,
  kStream = 148,
  kPauseStream = 150,
};

char byte(unsigned value) { return static_cast<char>(value & 0xffU); }

void add_word(std::string& text, std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  // The protocol is big-endian, two's complement.
  text += byte(bits >> 8U);
  text += byte(bits);
}

/// First and last packet number of a group.
struct Group {
  std::uint8_t id;
  std::uint8_t first;
  std::uint8_t last;
};
// From the list of sensor packets of the Open Interface specification.
constexpr std::array<Group, 11> kGroups{{{0, 7, 26},
                                         {1, 7, 16},
                                         {2, 17, 20},
                                         {3, 21, 26},
                                         {4, 27, 34},
                                         {5, 35, 42},
                                         {6, 7, 42},
                                         {100, 7, 58},
                                         {101, 43, 58},
                                         {106, 46, 51},
                                         {107, 54, 58}}};

std::size_t single_size(std::uint8_t id) noexcept {
  if (id < 7 || id > 58) return 0;
  constexpr std::array<std::uint8_t, 25> kWords{19, 20, 22, 23, 25, 26, 27, 28, 29, 30, 31, 33, 39,
                                                40, 41, 42, 43, 44, 46, 47, 48, 49, 50, 51, 54};
  if (id >= 54 && id <= 57) return 2;
  return std::find(kWords.begin(), kWords.end(), id) != kWords.end() ? 2 : 1;
}

}  // namespace

std::string_view to_string(Mode mode) noexcept {
  switch (mode) {
    case Mode::kOff:
      return "off";
    case Mode::kPassive:
      return "passive";
    case Mode::kSafe:
      return "safe";
    case Mode::kFull:
      return "full";
  }
  return "unknown";
}

std::size_t packet_size(std::uint8_t id) noexcept {
  for (const Group& group : kGroups) {
    if (group.id != id) continue;
    std::size_t size = 0;
    for (std::uint8_t i = group.first; i <= group.last; ++i) size += single_size(i);
    return size;
  }
  return single_size(id);
}

std::string start_command() { return {byte(kStart)}; }

std::string mode_command(Mode mode) {
  if (mode == Mode::kSafe) return {byte(kSafe)};
  if (mode == Mode::kFull) return {byte(kFull)};
  return start_command();
}

std::string pause_stream_command() { return {byte(kPauseStream), byte(0)}; }

std::string stream_command(std::span<const std::uint8_t> packets) {
  std::string text{byte(kStream), byte(static_cast<unsigned>(packets.size()))};
  for (const std::uint8_t id : packets) text += byte(id);
  return text;
}

std::string drive_direct_command(std::int32_t left_mmps, std::int32_t right_mmps) {
  std::string text{byte(kDriveDirect)};
  // The protocol sends the right wheel first.
  add_word(text, std::clamp(right_mmps, -kMaxWheel_mmps, kMaxWheel_mmps));
  add_word(text, std::clamp(left_mmps, -kMaxWheel_mmps, kMaxWheel_mmps));
  return text;
}

}  // namespace rave::oi
