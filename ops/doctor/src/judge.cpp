// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>

#include "rave/bus/wait_set.hpp"
#include "rave/doctor/ports.hpp"
#include "rave/doctor/probe_peer.hpp"

namespace rave::doctor {
namespace {

/// Certificates and logs need no better agreement of clocks; a run measures the offset itself.
constexpr double kSameTime_s = 2;

// The checks follow the way of a packet: is there a route and a listener, is it the same build, do
// clocks agree, which ports are open, does multicast pass, which sizes. Without an answer at all
// nothing else is asked.
class Judge {
 public:
  Judge(const ProbeResult& result, const About& here)
      : result_(result), there_(result.about), here_(here) {}

  Findings all() {
    port_state();
    if (result_.port != ProbeResult::PortState::kOpen) return std::move(findings_);
    sameness();
    clock();
    ports();
    multicast();
    sizes();
    return std::move(findings_);
  }

 private:
  void add(const char* check, Verdict verdict, std::string what, std::string mend = {}) {
    findings_.push_back(
        {check, verdict, fmt::format("{}: {}", result_.peer, what), std::move(mend)});
  }
  void good(const char* check, std::string what) { add(check, Verdict::kGood, std::move(what)); }
  void problem(const char* check, std::string what, std::string mend) {
    add(check, Verdict::kProblem, std::move(what), std::move(mend));
  }

  void port_state() {
    const unsigned first = first_port(here_.domain);
    const unsigned last = last_port(here_.domain);
    const std::string listen = fmt::format(
        "rave doctor --listen --interface {} --domain {}    # there", result_.peer, here_.domain);
    // First, because an answer from another domain explains the silence in this one.
    if (result_.other_domain) {
      problem(
          "domain",
          fmt::format("it uses domain {}, this machine {}", *result_.other_domain, here_.domain),
          fmt::format("--domain {}    # here, or the other number there", *result_.other_domain));
      return;
    }
    switch (result_.port) {
      case ProbeResult::PortState::kOpen:
        good("way", fmt::format("`{}` answers", there_.machine));
        return;
      case ProbeResult::PortState::kRefused:
        problem("way", "the machine is reachable, but `rave doctor --listen` does not run on it",
                listen);
        return;
      case ProbeResult::PortState::kNoWay:
        problem("way", fmt::format("there is no route to it ({})", result_.why),
                fmt::format("ip route get {0}; ping -c 3 {0}    # which address does it have?",
                            result_.peer));
        return;
      case ProbeResult::PortState::kSilent:
        problem(
            "way",
            fmt::format("no answer: `rave doctor --listen` does not run there, a cable is "
                        "unplugged, or a firewall on one of the machines drops UDP ports {} to {}",
                        first, last),
            listen + fmt::format("; sudo nft insert rule inet filter input udp dport {}-{} "
                                 "accept    # on both",
                                 first, last));
        return;
    }
  }

  void sameness() {
    if (there_.interface_stamp != here_.interface_stamp || there_.version != here_.version) {
      const bool same = there_.interface_stamp == here_.interface_stamp;
      add("version", same ? Verdict::kAdvice : Verdict::kProblem,
          fmt::format("it has RAVE {}{}, and this machine {}", there_.version,
                      same ? "" : " with other interfaces", here_.version),
          "install the same version on both machines");
    } else {
      good("version", fmt::format("{} on both", here_.version));
    }
    if (there_.authority != here_.authority) {
      const auto has = [](const About& about) {
        return about.authority.empty() ? std::string("no certificates")
                                       : fmt::format("those of {:.17}", about.authority);
      };
      problem("keys", fmt::format("it has {}, and this machine {}", has(there_), has(here_)),
              "rave keys new SET here there    # one set for all; then --security on both");
    } else if (!here_.authority.empty()) {
      good("keys", "of the same authority");
    }
    if (there_.multicast != here_.multicast) {
      add("settings", Verdict::kAdvice,
          fmt::format("it uses --multicast {}, this machine --multicast {}", there_.multicast,
                      here_.multicast),
          fmt::format("--multicast {}    # there", here_.multicast));
    }
  }

  void clock() {
    if (!result_.clock) return;
    const double offset_s = result_.clock->offset.seconds();
    const std::string text =
        fmt::format("its clock differs from the clock here by {:+.3f} s (uncertainty {:.3f} s)",
                    offset_s, result_.clock->bound.seconds());
    if (std::fabs(offset_s) <= kSameTime_s + result_.clock->bound.seconds()) {
      good("clock", text);
      return;
    }
    problem("clock", text, "sudo timedatectl set-ntp true    # on both");
  }

  void ports() {
    const bool none = there_.discovery_port == 0;
    if (none) {
      problem("ports", "no UDP port is free there for another process in the domain",
              "sudo ss -ulpn    # there: lists the programs that use them");
      return;
    }
    if (result_.discovery_open && result_.data_open) {
      good("ports", fmt::format("{} and {} are reached", there_.discovery_port, there_.data_port));
      return;
    }
    problem(
        "ports",
        fmt::format(
            "UDP port {} cannot be reached, but {} can: a firewall blocks some ports of the domain",
            result_.discovery_open ? there_.data_port : there_.discovery_port,
            doctor_port(here_.domain)),
        fmt::format("sudo nft insert rule inet filter input udp dport {}-{} accept    # there",
                    first_port(here_.domain), last_port(here_.domain)));
  }

  void multicast() {
    if (here_.multicast == bus::kMulticastNames.front()) return;
    const bool tried = result_.multicast_there && result_.multicast_back;
    if (tried && *result_.multicast_there && *result_.multicast_back) {
      good("multicast", "both ways");
      return;
    }
    const char* const what = !tried                     ? "it has not joined the multicast group"
                             : *result_.multicast_there ? "its multicast packets do not arrive here"
                             : *result_.multicast_back
                                 ? "multicast packets from here do not arrive there"
                                 : "multicast packets arrive in neither direction";
    problem("multicast", what,
            fmt::format("--multicast none --peer {}    # a list of all machines, on each",
                        result_.peer));
  }

  void sizes() {
    const auto lost = std::ranges::find_if(
        result_.sizes, [](const ProbeResult::Size& size) { return !size.there || !size.back; });
    if (lost == result_.sizes.end()) {
      if (!result_.sizes.empty()) {
        good("sizes", fmt::format("datagrams up to {} bytes arrive", result_.sizes.back().bytes));
      }
      return;
    }
    problem("sizes",
            fmt::format("datagrams of {} bytes and more do not {}: packet fragments are dropped, "
                        "or the MTU along the route is smaller than at one end",
                        lost->bytes, lost->there ? "come back" : "arrive"),
            // 1472 bytes of data are a full Ethernet frame of 1500 with the headers of IP and UDP.
            // If these are lost already, the MTU on the way is smaller than usual.
            fmt::format("ip link show    # compare the mtu on both; sudo ip link set DEV mtu {}",
                        lost->bytes <= 1472 ? 1400 : 1500));
  }

  const ProbeResult& result_;
  const About& there_;
  const About& here_;
  Findings findings_;
};

}  // namespace

Findings judge(const ProbeResult& result, const About& here) { return Judge(result, here).all(); }

Finding check_bus(const bus::BusConfig& given, const std::string& participant) {
  bus::BusConfig config = given;
  // As a monitor: the doctor must not be taken for a process of the run.
  config.anonymous = true;
  const auto bus = bus::Bus::open(config);
  if (!bus) return {"bus", Verdict::kProblem, bus.error().message, "rave doctor --help"};
  auto waits = bus::WaitSet::create(**bus);
  if (!waits || !waits->add_events()) return {"bus", Verdict::kUnknown, "cannot wait on it", {}};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(3);
  std::size_t seen = 0;
  for (;;) {
    static_cast<void>((*bus)->take_events());
    const auto processes = (*bus)->processes();
    seen = processes.size();
    if (std::ranges::find(processes, participant, &bus::BusProcess::name) != processes.end()) {
      return {"bus", Verdict::kGood, fmt::format("`{}` is seen on it", participant), {}};
    }
    const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(
        end - std::chrono::steady_clock::now());
    if (left.count() <= 0) break;
    static_cast<void>(waits->wait(Duration{left.count()}));
  }
  if (participant.empty()) {
    return {"bus", Verdict::kGood, fmt::format("{} other processes are seen on it", seen), {}};
  }
  return {"bus", Verdict::kProblem,
          fmt::format("`{}` answers, but is not visible on the bus: its --peer, --multicast, "
                      "--security or --bus-tag differ from those here",
                      participant),
          "rave doctor --listen    # there, with the same options as here"};
}

}  // namespace rave::doctor
