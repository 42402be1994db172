// SPDX-License-Identifier: Apache-2.0
#include "rave/doctor/examine.hpp"

#include <algorithm>

#include "rave/doctor/checks.hpp"
#include "rave/doctor/probe_peer.hpp"

namespace rave::doctor {

Findings examine(const Machine& machine, const bus::BusConfig& config, const About& here) {
  // From what needs only this machine to what needs another one: a later check would fail for the
  // reason that an earlier one names.
  std::vector<std::string> peers;
  Findings findings = {check_kernel(machine),
                       check_interface(machine, config),
                       check_peers(machine, config, peers),
                       check_domain(machine, config),
                       check_ports(config),
                       check_own_way(machine, config),
                       check_multicast(machine, config),
                       check_keys(config.security, machine.now_s),
                       check_clock(machine),
                       check_receive_buffer(machine),
                       check_open_files(machine),
                       check_cyclone_uri(machine)};
  // Without a way out of this machine there is nothing to learn from others.
  const auto broken = [&](std::string_view check) {
    return std::ranges::any_of(findings, [&](const Finding& finding) {
      return finding.check == check && finding.verdict == Verdict::kProblem;
    });
  };
  if (broken("interface")) return findings;
  // Joining the bus with broken settings would only repeat their messages.
  const bool can_join = !broken("peers") && !broken("keys") && !broken("domain") && !broken("self");
  ProbeOptions options;
  options.address = machine.find(config.interface)->address;
  options.domain = config.domain;
  options.multicast = config.multicast != bus::Multicast::kNone;
  bool any = false;
  for (const std::string& peer : peers) {
    const ProbeResult result = probe_peer(peer, options);
    for (Finding& finding : judge(result, here)) findings.push_back(std::move(finding));
    // With other certificates it is seen there all the same, and gives and gets nothing.
    const bool same_keys = result.about.authority == here.authority;
    if (result.about.participant.empty() || !can_join || !same_keys) continue;
    findings.push_back(check_bus(config, result.about.participant));
    any = true;
  }
  if (can_join && !any) findings.push_back(check_bus(config, {}));
  return findings;
}

}  // namespace rave::doctor
