// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace peer {

/// What a bad cable makes of the scans that follow.
enum class Fault { kNone, kGarble, kTear, kRepeat, kDelay };

[[nodiscard]] const char* to_string(Fault fault);
/// kNone if nothing is called so.
[[nodiscard]] Fault fault_named(const std::string& name);

/// A piece of bytes and how much later than the one before it leaves.
struct Chunk {
  std::string bytes;
  std::int64_t pause_ns = 0;
};

/// The bytes as they arrive: 3 to 30 of them replaced; a piece lost; a piece or all of it twice; or
/// a pause in the middle.
[[nodiscard]] std::vector<Chunk> spoil(const std::string& bytes, Fault fault,
                                       std::mt19937_64& random);

}  // namespace peer
