// SPDX-License-Identifier: Apache-2.0
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "rave/doctor/checks.hpp"
#include "rave/doctor/ports.hpp"
#include "ruleset.hpp"

namespace rave::doctor {
namespace {

/// What a command prints; nothing if it fails.
std::optional<std::string> output_of(const char* command) {
  std::FILE* const pipe = ::popen(command, "re");
  if (pipe == nullptr) return std::nullopt;
  std::string text;
  std::array<char, 4096> part{};
  std::size_t size = 0;
  constexpr std::size_t kMost = 16U << 20U;
  while (text.size() < kMost && (size = std::fread(part.data(), 1, part.size(), pipe)) > 0) {
    text.append(part.data(), size);
  }
  const int status = ::pclose(pipe);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? std::optional(text) : std::nullopt;
}

/// `/usr/sbin` is not in everybody's path.
constexpr const char* kList = "PATH=\"$PATH:/usr/sbin:/sbin\" nft -j list ruleset 2>/dev/null";

bool old_tables() {
  std::FILE* const file = std::fopen("/proc/net/ip_tables_names", "re");
  if (file == nullptr) return false;
  const bool any = std::fgetc(file) != EOF;
  std::fclose(file);
  return any;
}

}  // namespace

Finding check_ruleset(std::string_view text, std::uint32_t domain, std::string_view interface) {
  const auto rules = Ruleset::parse(text);
  if (!rules) return {"firewall", Verdict::kUnknown, rules.error().message, {}};
  const unsigned first = first_port(domain);
  const unsigned last = last_port(domain);
  Fate worst;
  unsigned from = 0;
  unsigned to = 0;
  for (unsigned port = first; port <= last; ++port) {
    const Fate fate = rules->fate_of({static_cast<std::uint16_t>(port), std::string(interface)});
    if (!fate.dropped) continue;
    const bool worse = !worst.dropped || (worst.perhaps_not && !fate.perhaps_not);
    if (worse) from = port;
    if (worse || fate.chain == worst.chain) to = port;
    if (worse) worst = fate;
  }
  if (!worst.dropped) {
    return {"firewall", Verdict::kGood, fmt::format("nothing drops UDP {} to {}", first, last), {}};
  }
  const std::string ports =
      from == to ? fmt::format("port {}", from) : fmt::format("ports {} to {}", from, to);
  return {"firewall", worst.perhaps_not ? Verdict::kAdvice : Verdict::kProblem,
          fmt::format("the chain `{}` {} UDP to {}", worst.chain,
                      worst.perhaps_not ? "has a rule that may drop" : "drops", ports),
          fmt::format("sudo nft insert rule {} udp dport {}-{} accept", worst.chain, first, last)};
}

Finding check_firewall(const Machine& machine, const bus::BusConfig& config) {
  const Interface* const interface = machine.find(config.interface);
  const std::string name = interface != nullptr ? interface->name : config.interface;
  const auto text = output_of(kList);
  if (text) {
    Finding finding = check_ruleset(*text, std::min(config.domain, kMostDomain), name);
    if (finding.verdict == Verdict::kGood && old_tables()) {
      return {"firewall", Verdict::kUnknown,
              "nft has no rule against us, but there are tables of the older iptables",
              "sudo iptables-legacy -S    # lists them"};
    }
    return finding;
  }
  if (::geteuid() != 0) {
    return {"firewall", Verdict::kUnknown, "only root may read the rules of the packet filter",
            "sudo rave doctor    # with the same options"};
  }
  return {"firewall", Verdict::kUnknown,
          "the rules of the packet filter cannot be read: nft is missing or fails",
          "sudo apt-get install nftables"};
}

}  // namespace rave::doctor
