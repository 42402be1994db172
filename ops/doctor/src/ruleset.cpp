// SPDX-License-Identifier: Apache-2.0
#include "ruleset.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

namespace rave::doctor {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 16;
/// Chains that jump to one another would be walked for ever.
constexpr int kMostRules = 20'000;
/// Deeper than any rule, and no danger to a parser that recurses.
constexpr int kDeepestText = 64;

bool too_deep(std::string_view text) {
  int depth = 0;
  for (const char c : text) {
    if (c == '{' || c == '[') ++depth;
    if (c == '}' || c == ']') --depth;
    if (depth > kDeepestText) return true;
  }
  return false;
}

const Json* entry_of(const Json& json, const char* key) {
  if (!json.is_object()) return nullptr;
  const auto found = json.find(key);
  return found == json.end() ? nullptr : &*found;
}

std::string text_of(const Json& json, const char* key) {
  const Json* const value = entry_of(json, key);
  return value != nullptr && value->is_string() ? value->get<std::string>() : std::string();
}

/// The members of a set, or the one thing that it is.
std::vector<const Json*> members_of(const Json& json) {
  const Json* const set = entry_of(json, "set");
  const Json& list = set != nullptr ? *set : json;
  std::vector<const Json*> members;
  if (!list.is_array()) return {&list};
  for (const Json& member : list) {
    const Json* const element = entry_of(member, "elem");
    const Json* const value = element != nullptr ? entry_of(*element, "val") : nullptr;
    members.push_back(value != nullptr ? value : &member);
  }
  return members;
}

using Range = std::pair<std::uint32_t, std::uint32_t>;

std::optional<Range> range_of(const Json& json) {
  const Json* const range = entry_of(json, "range");
  const Json& low =
      range != nullptr && range->is_array() && range->size() == 2 ? (*range)[0] : json;
  const Json& high =
      range != nullptr && range->is_array() && range->size() == 2 ? (*range)[1] : json;
  if (!low.is_number_unsigned() || !high.is_number_unsigned()) return std::nullopt;
  const auto bounded = [](const Json& number) {
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(number.get<std::uint64_t>(), 65'536));
  };
  return Range{bounded(low), bounded(high)};
}

bool fits(const std::string& pattern, const std::string& name) {
  return pattern.ends_with('*') ? name.starts_with(pattern.substr(0, pattern.size() - 1))
                                : name == pattern;
}

}  // namespace

/// Makes rules of JSON.
class Ruleset::Reader {
 public:
  void read(const Json& entry, std::vector<Chain>& chains) {
    if (const Json* const chain = entry_of(entry, "chain")) read_chain(*chain, chains);
    if (const Json* const rule = entry_of(entry, "rule")) read_rule(*rule, chains);
  }

 private:
  static bool of_interest(const std::string& family) { return family == "ip" || family == "inet"; }

  static void read_chain(const Json& json, std::vector<Chain>& chains) {
    const std::string family = text_of(json, "family");
    if (!of_interest(family)) return;
    Chain chain;
    chain.table = family + " " + text_of(json, "table");
    chain.name = text_of(json, "name");
    const std::string hook = text_of(json, "hook");
    chain.on_the_way_in =
        hook == "input" || (hook == "prerouting" && text_of(json, "type") != "nat");
    chain.drops = text_of(json, "policy") == "drop";
    if (const Json* const priority = entry_of(json, "prio");
        priority && priority->is_number_integer()) {
      chain.priority = priority->get<int>() - (hook == "prerouting" ? 100'000 : 0);
    }
    chains.push_back(std::move(chain));
  }

  static void read_rule(const Json& json, std::vector<Chain>& chains) {
    const std::string table = text_of(json, "family") + " " + text_of(json, "table");
    const std::string name = text_of(json, "chain");
    const auto chain = std::ranges::find_if(
        chains, [&](const Chain& c) { return c.table == table && c.name == name; });
    const Json* const parts = entry_of(json, "expr");
    if (chain == chains.end() || parts == nullptr || !parts->is_array()) return;
    Rule rule;
    for (const Json& part : *parts) read_part(part, rule);
    chain->rules.push_back(std::move(rule));
  }

  static void read_part(const Json& part, Rule& rule) {
    if (!part.is_object() || part.empty()) return;
    const std::string kind = part.begin().key();
    const Json& what = part.begin().value();
    if (kind == "match") rule.conditions.push_back(condition_of(what));
    if (kind == "limit" || kind == "xt" || kind == "quota" || kind == "ct count") {
      rule.conditions.push_back({});
    }
    if (kind == "accept") rule.end = End::kAccept;
    if (kind == "drop" || kind == "reject") rule.end = End::kDrop;
    if (kind == "return") rule.end = End::kReturn;
    if (kind == "jump" || kind == "goto") {
      rule.end = kind == "jump" ? End::kJump : End::kGoto;
      rule.target = text_of(what, "target");
    }
    if (kind == "queue" || kind == "vmap") {  // somebody else decides
      rule.conditions.push_back({});
      rule.end = End::kDrop;
    }
  }

  static Condition known(bool truth, bool negated) {
    Condition condition;
    condition.about = truth != negated ? Condition::About::kTrue : Condition::About::kFalse;
    return condition;
  }

  static Condition condition_of(const Json& match) {
    const Json* const left = entry_of(match, "left");
    const Json* const right = entry_of(match, "right");
    if (left == nullptr || right == nullptr) return {};
    const std::string op = text_of(match, "op");
    const bool negated = op == "!=";
    if (const Json* const payload = entry_of(*left, "payload")) {
      const std::string protocol = text_of(*payload, "protocol");
      const std::string field = text_of(*payload, "field");
      if (protocol == "ip" && field == "protocol") return protocol_is(*right, negated);
      if (protocol == "udp" || protocol == "th") {
        return field == "dport" ? port_is(op, *right) : Condition{};
      }
      const bool other = protocol != "ip" && protocol != "ether" && !protocol.empty();
      return other ? known(false, false) : Condition{};
    }
    if (const Json* const meta = entry_of(*left, "meta")) {
      const std::string key = text_of(*meta, "key");
      if (key == "l4proto") return protocol_is(*right, negated);
      if (key == "iifname" || key == "iif") return interface_is(*right, negated);
      if (key == "nfproto") return known(has(*right, "ipv4"), negated);
      return {};
    }
    if (const Json* const ct = entry_of(*left, "ct");
        ct != nullptr && text_of(*ct, "key") == "state") {
      return known(has(*right, "new"), negated);
    }
    return {};
  }

  static bool has(const Json& right, std::string_view word) {
    const auto members = members_of(right);
    return std::ranges::any_of(members, [&](const Json* member) {
      return member->is_string() && member->get<std::string>() == word;
    });
  }

  static Condition protocol_is(const Json& right, bool negated) {
    constexpr unsigned kUdp = 17;
    const auto members = members_of(right);
    const bool by_number = std::ranges::any_of(members, [](const Json* member) {
      return member->is_number_unsigned() && member->get<std::uint64_t>() == kUdp;
    });
    return known(by_number || has(right, "udp"), negated);
  }

  static Condition interface_is(const Json& right, bool negated) {
    Condition condition;
    condition.about = Condition::About::kInterface;
    condition.negated = negated;
    for (const Json* const member : members_of(right)) {
      if (!member->is_string() || member->get<std::string>().starts_with("@")) return {};
      condition.names.push_back(member->get<std::string>());
    }
    return condition;
  }

  static Condition port_is(const std::string& op, const Json& right) {
    Condition condition;
    condition.about = Condition::About::kPort;
    condition.negated = op == "!=";
    for (const Json* const member : members_of(right)) {
      auto range = range_of(*member);
      if (!range) return {};
      constexpr std::uint32_t kMost = 65'535;
      if (op == "<") range = range->first == 0 ? Range{1, 0} : Range{0, range->first - 1};
      if (op == "<=") range = Range{0, range->first};
      if (op == ">") range = Range{range->first + 1, kMost};
      if (op == ">=") range = Range{range->first, kMost};
      condition.ranges.push_back(*range);
    }
    return condition;
  }
};

Result<Ruleset> Ruleset::parse(std::string_view text) {
  if (too_deep(text)) return fail(ErrorCode::kParse, "the list of rules is nested too deeply");
  const Json json = Json::parse(text, nullptr, false);
  const Json* const entries = entry_of(json, "nftables");
  if (entries == nullptr || !entries->is_array()) {
    return fail(ErrorCode::kParse, "this is not what `nft -j list ruleset` prints");
  }
  Ruleset ruleset;
  Reader reader;
  for (const Json& entry : *entries) reader.read(entry, ruleset.chains_);
  std::ranges::stable_sort(ruleset.chains_, {}, &Chain::priority);
  return ruleset;
}

Ruleset::Truth Ruleset::judge(const Rule& rule, const Packet& packet) {
  Truth all = Truth::kYes;
  for (const Condition& condition : rule.conditions) {
    Truth truth = Truth::kPerhaps;
    using enum Condition::About;
    if (condition.about == kTrue) truth = Truth::kYes;
    if (condition.about == kFalse) truth = Truth::kNo;
    if (condition.about == kPort || condition.about == kInterface) {
      const bool found = condition.about == kPort
                             ? std::ranges::any_of(condition.ranges,
                                                   [&](const auto& range) {
                                                     return packet.port >= range.first &&
                                                            packet.port <= range.second;
                                                   })
                             : std::ranges::any_of(condition.names, [&](const std::string& name) {
                                 return fits(name, packet.interface);
                               });
      truth = found != condition.negated ? Truth::kYes : Truth::kNo;
    }
    all = std::min(all, truth);
  }
  return all;
}

const Ruleset::Chain* Ruleset::find(const std::string& table, const std::string& name) const {
  const auto chain = std::ranges::find_if(
      chains_, [&](const Chain& c) { return c.table == table && c.name == name; });
  return chain == chains_.end() ? nullptr : &*chain;
}

Ruleset::End Ruleset::follow(const Chain& chain, Walk& walk, int depth) const {
  if (depth > kDeepest) return End::kNone;
  const Packet& packet = walk.packet;
  Fate& fate = walk.fate;
  for (const Rule& rule : chain.rules) {
    if (--walk.rules_left < 0) return End::kNone;
    const Truth truth = judge(rule, packet);
    if (truth == Truth::kNo || rule.end == End::kNone) continue;
    End end = rule.end;
    if (end == End::kJump || end == End::kGoto) {
      const Chain* const target = find(chain.table, rule.target);
      end = target == nullptr ? End::kNone : follow(*target, walk, depth + 1);
      if (rule.end == End::kGoto && end == End::kNone) end = End::kReturn;
    }
    if (end == End::kNone) continue;
    if (truth == Truth::kPerhaps) {
      // Both may happen; the worse of the two is what somebody should look at.
      if (end == End::kDrop) return fate.perhaps_not = true, End::kDrop;
      fate.perhaps_not = true;
      continue;
    }
    return end == End::kReturn ? End::kNone : end;
  }
  return End::kNone;
}

Fate Ruleset::fate_of(const Packet& packet) const {
  for (const Chain& chain : chains_) {
    if (!chain.on_the_way_in) continue;
    Walk walk{packet, {}, kMostRules};
    Fate& fate = walk.fate;
    End end = follow(chain, walk, 0);
    if (end == End::kNone && chain.drops) end = End::kDrop;
    if (end != End::kDrop) continue;
    fate.dropped = true;
    fate.chain = chain.table + " " + chain.name;
    return fate;
  }
  return {};
}

}  // namespace rave::doctor
