// SPDX-License-Identifier: Apache-2.0
#include "faults.hpp"

namespace peer {
namespace {

constexpr std::int64_t kPause_ns = 30'000'000;

std::size_t below(std::size_t limit, std::mt19937_64& random) { return random() % limit; }

std::string garbled(std::string bytes, std::mt19937_64& random) {
  const std::size_t count = 3 + below(28, random);
  for (std::size_t i = 0; i < count; ++i) {
    bytes[below(bytes.size(), random)] = static_cast<char>(below(256, random));
  }
  return bytes;
}

}  // namespace

const char* to_string(Fault fault) {
  static constexpr const char* kNames[] = {"none", "garble", "tear", "repeat", "delay"};
  return kNames[static_cast<int>(fault)];
}

Fault fault_named(const std::string& name) {
  for (const Fault fault : {Fault::kGarble, Fault::kTear, Fault::kRepeat, Fault::kDelay}) {
    if (name == to_string(fault)) return fault;
  }
  return Fault::kNone;
}

std::vector<Chunk> spoil(const std::string& bytes, Fault fault, std::mt19937_64& random) {
  const std::size_t at = below(bytes.size(), random);
  const std::size_t length = 1 + below(bytes.size() - at, random);
  switch (fault) {
    case Fault::kGarble:
      return {{garbled(bytes, random), 0}};
    case Fault::kTear:
      return {{std::string(bytes).erase(at, length), 0}};
    case Fault::kRepeat:
      if (below(2, random) == 0) return {{bytes + bytes, 0}};
      return {{std::string(bytes).insert(at, bytes.substr(at, length)), 0}};
    case Fault::kDelay:
      return {{bytes.substr(0, at), 0}, {bytes.substr(at), kPause_ns}};
    case Fault::kNone:
      break;
  }
  return {{bytes, 0}};
}

}  // namespace peer
