// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <filesystem>

#include "rave/base/names.hpp"
#include "rave/doctor/checks.hpp"
#include "rave/doctor/ports.hpp"

namespace rave::doctor {
namespace {

constexpr std::uint64_t kFewFiles = 256;
/// A world message of 10 000 robots has 600 kB.
constexpr std::uint64_t kWorld_bytes = 1U << 20U;
/// The size that rave::bus requests.
constexpr std::uint64_t kWanted_bytes = 8U << 20U;
/// 2020-01-01: an earlier clock is certainly wrong.
constexpr std::int64_t kYoung_s = 1'577'836'800;

bool elsewhere(std::string_view peer) { return !peer.starts_with("127.") && peer != "localhost"; }

std::string some_address(const Machine& machine) {
  for (const Interface& interface : machine.interfaces) {
    if (!interface.loopback && interface.up && !interface.address.empty()) return interface.address;
  }
  return "ADDRESS";
}

std::string names_of(const Machine& machine) {
  std::string text;
  for (const Interface& interface : machine.interfaces) {
    if (interface.address.empty()) continue;
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", interface.name, interface.address);
  }
  return text.empty() ? "none" : text;
}

}  // namespace

Finding check_interface(const Machine& machine, const bus::BusConfig& config) {
  Finding finding{"interface"};
  const auto problem = [&](std::string what, std::string mend) {
    finding.verdict = Verdict::kProblem;
    finding.what = std::move(what);
    finding.mend = std::move(mend);
    return finding;
  };
  const Interface* const found = machine.find(config.interface);
  if (found == nullptr) {
    std::vector<std::string_view> names;
    for (const Interface& interface : machine.interfaces) names.push_back(interface.name);
    return problem(fmt::format("there is no interface `{}`{}; there are {}", config.interface,
                               suggestion(config.interface, names), names_of(machine)),
                   fmt::format("--interface {}", some_address(machine)));
  }
  // From the coarse to the fine: an interface that is down may have no address either, and the
  // first reason is the one to repair.
  if (!found->up) {
    return problem(fmt::format("{} is down, or has no cable", found->name),
                   fmt::format("sudo ip link set {} up", found->name));
  }
  if (found->address.empty()) {
    return problem(fmt::format("{} has no IPv4 address", found->name),
                   fmt::format("sudo ip addr add ADDRESS/24 dev {}", found->name));
  }
  const bool far = std::ranges::any_of(config.peers, elsewhere);
  // The default interface reaches this machine only. It is the usual mistake in a first run over
  // two machines.
  if (found->loopback && (far || config.multicast != bus::Multicast::kNone)) {
    return problem(fmt::format("{} reaches only this machine, but other machines are to be found",
                               found->name),
                   fmt::format("--interface {}", some_address(machine)));
  }
  finding.what = fmt::format("{} with {}", found->name, found->address);
  return finding;
}

Finding check_kernel(const Machine& machine) {
  Finding finding{"kernel", Verdict::kGood, machine.kernel, {}};
  const char* at = machine.kernel.data();
  const char* const end = at + machine.kernel.size();
  unsigned major = 0;
  unsigned minor = 0;
  const auto [dot, error] = std::from_chars(at, end, major);
  if (error != std::errc() || dot == end || *dot != '.' ||
      std::from_chars(dot + 1, end, minor).ec != std::errc()) {
    return {"kernel", Verdict::kUnknown, fmt::format("cannot tell from `{}`", machine.kernel), {}};
  }
  // Children are owned by descriptors (libs/process), and pidfd_open() exists since Linux 5.3.
  if (major > 5 || (major == 5 && minor >= 3)) return finding;
  finding.verdict = Verdict::kProblem;
  finding.what = fmt::format("Linux {} is older than 5.3, which RAVE needs", machine.kernel);
  finding.mend = "sudo apt-get install linux-image-amd64 && sudo reboot";
  return finding;
}

Finding check_open_files(const Machine& machine) {
  if (machine.open_files >= kFewFiles) {
    return {"files", Verdict::kGood, fmt::format("{} may be open", machine.open_files), {}};
  }
  return {"files", Verdict::kProblem,
          fmt::format("a process may open only {} files; sockets and recordings may need more",
                      machine.open_files),
          "ulimit -n 1024"};
}

Finding check_receive_buffer(const Machine& machine) {
  if (!machine.receive_buffer_max) {
    return {"buffers", Verdict::kUnknown, "the kernel does not report their maximum size", {}};
  }
  const std::uint64_t most = *machine.receive_buffer_max;
  if (most >= kWorld_bytes) {
    return {"buffers",
            Verdict::kGood,
            fmt::format("socket buffers may have up to {} kB", most / 1024),
            {}};
  }
  return {"buffers", Verdict::kAdvice,
          fmt::format("socket buffers are limited to {} kB; a world of 10 000 robots needs 600 kB, "
                      "and packets that do not fit are lost and sent again",
                      most / 1024),
          fmt::format("sudo sysctl -w net.core.rmem_max={}", kWanted_bytes)};
}

Finding check_domain(const Machine& machine, const bus::BusConfig& config) {
  if (config.domain > kMostDomain) {
    return {"domain", Verdict::kProblem,
            fmt::format("{} is not in 0 to {}", config.domain, kMostDomain), "--domain 0"};
  }
  const unsigned first = first_port(config.domain);
  const unsigned last = last_port(config.domain);
  const std::string range = fmt::format("{}: UDP ports {} to {}", config.domain, first, last);
  // The kernel gives such ports to any socket that asks for a free one, and a process of the run
  // then finds it in use.
  const bool shared = machine.first_handed_out && machine.last_handed_out &&
                      first <= *machine.last_handed_out && last >= *machine.first_handed_out;
  if (!shared) return {"domain", Verdict::kGood, range, {}};
  return {"domain", Verdict::kAdvice,
          fmt::format("{}; the kernel also gives some of them to other programs ({} to {})", range,
                      *machine.first_handed_out, *machine.last_handed_out),
          "--domain 0    # on all machines; any domain up to 99"};
}

Finding check_cyclone_uri(const Machine& machine) {
  Finding finding{"settings"};
  if (machine.cyclone_uri.empty()) {
    finding.what = "CYCLONEDDS_URI is not set";
    return finding;
  }
  // The variable is a list of XML fragments and file names.
  constexpr std::string_view kFile = "file://";
  std::string_view rest = machine.cyclone_uri;
  while (!rest.empty()) {
    const std::string_view entry = rest.substr(0, rest.find(','));
    rest.remove_prefix(std::min(rest.size(), entry.size() + 1));
    if (!entry.starts_with(kFile)) continue;
    const std::filesystem::path path(entry.substr(kFile.size()));
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) continue;
    return {
        "settings", Verdict::kProblem,
        fmt::format("CYCLONEDDS_URI names {}, which is not a file; programs of ROS 2 do not start "
                    "with it",
                    path.string()),
        "unset CYCLONEDDS_URI"};
  }
  finding.verdict = Verdict::kAdvice;
  finding.what =
      "CYCLONEDDS_URI is set: RAVE does not read it, programs of ROS 2 on this machine do";
  finding.mend = "unset CYCLONEDDS_URI";
  return finding;
}

Finding check_clock(const Machine& machine) {
  if (machine.now_s >= kYoung_s) return {"clock", Verdict::kGood, "plausible", {}};
  return {"clock", Verdict::kProblem,
          "the clock of this machine is before 2020: certificates are not valid yet",
          "sudo timedatectl set-ntp true"};
}

}  // namespace rave::doctor
