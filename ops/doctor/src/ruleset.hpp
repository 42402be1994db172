// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "rave/base/result.hpp"

namespace rave::doctor {

/// A new UDP packet that comes in.
struct Packet {
  std::uint16_t port = 0;  ///< That it is for.
  std::string interface;
};

/// What becomes of a packet.
struct Fate {
  bool dropped = false;
  /// A condition that cannot be judged from outside, such as a list of senders or chance, stood
  /// before an end of the other kind.
  bool perhaps_not = false;
  std::string chain{};  ///< Which drops it, as nft names it: `inet filter input`.
};

/// The rules of a packet filter. Immutable.
class Ruleset {
 public:
  /// `text`: what `nft -j list ruleset` prints. Error kParse.
  [[nodiscard]] static Result<Ruleset> parse(std::string_view text);

  /// Follows a packet through the chains of its way in.
  [[nodiscard]] Fate fate_of(const Packet& packet) const;

 private:
  enum class Truth : std::uint8_t { kNo, kPerhaps, kYes };
  enum class End : std::uint8_t { kNone, kAccept, kDrop, kReturn, kJump, kGoto };
  struct Condition {
    enum class About : std::uint8_t { kPort, kInterface, kTrue, kFalse, kUnknown };
    About about = About::kUnknown;
    bool negated = false;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> ranges{};  ///< kPort; one of them.
    std::vector<std::string> names{};                               ///< kInterface; one of them.
  };
  struct Rule {
    std::vector<Condition> conditions;
    End end = End::kNone;
    std::string target;
  };
  struct Chain {
    std::string table;  ///< Family and name.
    std::string name;
    bool on_the_way_in = false;
    bool drops = false;  ///< Its policy.
    int priority = 0;
    std::vector<Rule> rules;
  };
  class Reader;

  [[nodiscard]] static Truth judge(const Rule& rule, const Packet& packet);
  [[nodiscard]] const Chain* find(const std::string& table, const std::string& name) const;
  /// A packet on its way, and how many rules it may still meet.
  struct Walk {
    const Packet& packet;
    Fate fate;
    int rules_left;
  };
  [[nodiscard]] End follow(const Chain& chain, Walk& walk, int depth) const;

  std::vector<Chain> chains_;
};

}  // namespace rave::doctor
