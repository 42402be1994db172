// SPDX-License-Identifier: Apache-2.0
// The settings of Cyclone DDS, made from those of a run.
#include "rave/bus/config.hpp"

#include <algorithm>
#include <string_view>

#include "rave/base/control_characters.hpp"
#include "rave/base/file.hpp"
#include "rave/base/markup.hpp"

namespace rave::bus {
namespace {

/// Names must not contain control characters; `$` would begin a variable in the XML.
bool plain(std::string_view text) {
  return !has_control_characters(text) && text.find('$') == std::string_view::npos;
}

bool is_address(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789.") == std::string_view::npos;
}

Status check_text(std::string_view field, std::string_view text, std::size_t longest) {
  if (text.size() > longest) {
    return fail(ErrorCode::kInvalidArgument, "{}: {} bytes; expected at most {}", field,
                text.size(), longest);
  }
  if (!plain(text)) {
    return fail(ErrorCode::kInvalidArgument, "{}: control characters and `$` are not allowed",
                field);
  }
  return {};
}

std::string general(const BusConfig& config) {
  const char* const kind = is_address(config.interface) ? "address" : "name";
  const char* const multicast = config.multicast == Multicast::kNone        ? "false"
                                : config.multicast == Multicast::kDiscovery ? "spdp"
                                                                            : "true";
  // The loopback interface supports multicast although Linux does not report it.
  const bool unsaid = config.loopback() && config.multicast != Multicast::kNone;
  const char* const assume = unsaid ? " multicast=\"true\"" : "";
  std::string xml = fmt::format(
      "<General><Interfaces><NetworkInterface {}=\"{}\"{}/></Interfaces>"
      "<AllowMulticast>{}</AllowMulticast>",
      kind, escaped_markup(config.interface), assume, multicast);
  // Loopback loses packets only through full buffers and permits packets of 64 KB. Elsewhere a
  // fragment must fit into an Ethernet frame, or the loss of one frame would cost 40 others.
  if (config.loopback()) {
    xml += "<MaxMessageSize>65500B</MaxMessageSize><FragmentSize>63000B</FragmentSize>";
  }
  return xml + "</General>";
}

/// The participant indices of the processes that a process with this reach looks for. Empty: any.
std::vector<int> places(const BusConfig& config) {
  if (config.multicast != Multicast::kNone || config.reach == Reach::kAll) return {};
  std::vector<int> places;
  const int plain = config.reach == Reach::kHubs ? 0 : config.max_processes;
  for (int i = 0; i < plain; ++i) places.push_back(i);
  for (int i = 0; i < BusConfig::kMostHubs; ++i) places.push_back(BusConfig::kMostPlain + i);
  return places;
}

/// The discovery port of the process with a participant index (RTPS 2.2, 9.6.1.1).
int port_of(const BusConfig& config, int place) {
  return 7400 + 250 * static_cast<int>(config.domain) + 10 + 2 * place;
}

/// A process announces itself again at least this often, for processes that did not hear it.
constexpr std::int64_t kLongestCall_ms = 30'000;

std::string discovery(const BusConfig& config, int hub) {
  std::vector<std::string> peers = config.peers;
  if (peers.empty() && config.loopback()) peers = {config.interface};
  const std::vector<int> where = places(config);
  const bool is_hub = config.reach == Reach::kHub && !where.empty();
  // With index `none` and without multicast, a process would only ever discover itself.
  std::string xml = fmt::format(
      "<Discovery><ParticipantIndex>{}</ParticipantIndex>"
      "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex>"
      "<LeaseDuration>{}ms</LeaseDuration><SPDPInterval>{}ms</SPDPInterval>",
      is_hub ? std::to_string(BusConfig::kMostPlain + hub) : "auto", config.max_processes - 1,
      std::max(config.lease, config.forget).ns / 1'000'000,
      std::min(config.lease.ns / 1'250'000, kLongestCall_ms));
  // The domain has another number within this process then.
  if (config.beside) xml += fmt::format("<ExternalDomainId>{}</ExternalDomainId>", config.domain);
  if (!config.tag.empty()) xml += fmt::format("<Tag>{}</Tag>", escaped_markup(config.tag));
  if (!peers.empty()) {
    xml += "<Peers>";
    for (const std::string& peer : peers) {
      if (where.empty()) xml += fmt::format("<Peer address=\"{}\"/>", escaped_markup(peer));
      for (const int place : where) {
        xml +=
            fmt::format("<Peer address=\"{}:{}\"/>", escaped_markup(peer), port_of(config, place));
      }
    }
    xml += "</Peers>";
  }
  return xml + "</Discovery>";
}

/// A world of 10 000 robots has half a megabyte: the default limits would stop a writer after one,
/// and a sample of many megabytes is invalid. The limit is fixed, because Cyclone DDS would lower
/// it to almost nothing after losses, and writers that do not block would drop samples for which
/// there is room. When many processes join at once, each is asked repeatedly by all others for
/// acknowledgements; at ten times a second, more than fifty of them could not answer before they
/// count as lost. Longer intervals would delay two processes that just miss each other. One thread
/// receives at all sockets and is ended through a descriptor. Threads with one socket each would be
/// ended by a packet that the process sends to itself; if its address is gone or a packet filter
/// drops it, closing the domain would block forever. Writers that end do not linger, since that
/// would be for the dead, too; Bus::remove_endpoint() waits for the living. Receive buffers fill
/// slowly and are replaced when full. With the default size of 1 MiB, an idle process touches new
/// pages for more than an hour, which looks like a leak.
std::string internals() {
  return "<Internal><SocketReceiveBufferSize max=\"8MiB\"/>"
         "<WriterLingerDuration>0s</WriterLingerDuration>"
         "<HeartbeatInterval>200ms</HeartbeatInterval>"
         "<MultipleReceiveThreads>false</MultipleReceiveThreads>"
         "<Watermarks><WhcHigh>16MB</WhcHigh><WhcHighInit>16MB</WhcHighInit>"
         "<WhcAdaptive>false</WhcAdaptive></Watermarks>"
         "<MaxSampleSize>16MiB</MaxSampleSize></Internal>"
         "<Sizing><ReceiveBufferSize>256KiB</ReceiveBufferSize></Sizing>"
         "<SharedMemory><Enable>false</Enable></SharedMemory>"
         "<Tracing><Verbosity>none</Verbosity></Tracing>";
}

std::string security(const std::filesystem::path& folder) {
  const auto file = [&](const char* name) {
    return "file:" + escaped_markup((std::filesystem::absolute(folder) / name).string());
  };
  const auto library = [](const char* name, const char* what) {
    return fmt::format(
        "<Library path=\"{}/libdds_security_{}.so\" initFunction=\"init_{}\" "
        "finalizeFunction=\"finalize_{}\"/>",
        escaped_markup(RAVE_DDS_SECURITY_FOLDER), name, what, what);
  };
  return "<Security><Authentication>" + library("auth", "authentication") + "<IdentityCA>" +
         file("identity_ca.pem") + "</IdentityCA><IdentityCertificate>" + file("identity.pem") +
         "</IdentityCertificate><PrivateKey>" + file("identity_key.pem") +
         "</PrivateKey></Authentication><AccessControl>" + library("ac", "access_control") +
         "<PermissionsCA>" + file("permissions_ca.pem") + "</PermissionsCA><Governance>" +
         file("governance.p7s") + "</Governance><Permissions>" + file("permissions.p7s") +
         "</Permissions></AccessControl><Cryptographic>" + library("crypto", "crypto") +
         "</Cryptographic></Security>";
}

// Checked here, because Cyclone DDS would only say that it cannot create a participant.
Status check_certificates(const std::filesystem::path& folder) {
  for (const char* const name : {"identity_ca.pem", "identity.pem", "identity_key.pem",
                                 "permissions_ca.pem", "governance.p7s", "permissions.p7s"}) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(folder / name, error)) {
      const bool set = std::filesystem::is_directory(folder / "ca", error);
      return fail(ErrorCode::kInvalidArgument, "security: there is no {}{}",
                  (folder / name).string(),
                  set ? "; this is a set of keys, name the folder of one member in it" : "");
    }
  }
  return check_private_file(folder / "identity_key.pem");
}

}  // namespace

std::optional<Multicast> multicast_of(std::string_view name) noexcept {
  const auto found = std::ranges::find(kMulticastNames, name);
  if (found == kMulticastNames.end()) return std::nullopt;
  return static_cast<Multicast>(found - kMulticastNames.begin());
}

bool BusConfig::loopback() const { return interface.starts_with("127.") || interface == "lo"; }

Status validate(const BusConfig& config) {
  constexpr ErrorCode kBad = ErrorCode::kInvalidArgument;
  if (config.participant.empty()) return fail(kBad, "participant: expected a name");
  RAVE_TRY(check_text("participant", config.participant, 64));
  RAVE_TRY(check_text("interface", config.interface, 255));
  RAVE_TRY(check_text("tag", config.tag, 255));
  if (config.run.none() && !config.anonymous)
    return fail(kBad, "run: expected an id, the same for all processes of a run");
  if (config.all_runs && (!config.anonymous || !config.run.none())) {
    return fail(kBad, "all_runs: only for an anonymous process without a run");
  }
  if (config.domain > 230) return fail(kBad, "domain: found {}, expected 0 to 230", config.domain);
  if (config.interface.empty()) return fail(kBad, "interface: expected an address or a name");
  if (config.max_processes < 1 || config.max_processes > 119) {
    return fail(kBad, "max_processes: found {}, expected 1 to 119", config.max_processes);
  }
  if (config.reach != Reach::kAll && config.max_processes > BusConfig::kMostPlain) {
    return fail(kBad, "max_processes: found {}, expected 1 to {}, in addition to hubs",
                config.max_processes, BusConfig::kMostPlain);
  }
  if (config.lease.ns < 100'000'000 || config.lease.ns > 3600'000'000'000) {
    return fail(kBad, "lease: found {} s, expected 0.1 s to 3600 s", config.lease.seconds());
  }
  for (const std::string& peer : config.peers) {
    RAVE_TRY(check_text("peers", peer, 255));
    if (peer.empty()) return fail(kBad, "peers: an empty address");
  }
  if (config.peers.empty() && config.multicast == Multicast::kNone && !config.loopback()) {
    return fail(kBad,
                "peers: without multicast no process is found on {}; list all machines of the run, "
                "this one included, or allow multicast",
                config.interface);
  }
  if (!config.security.empty()) RAVE_TRY(check_certificates(config.security));
  return {};
}

std::string cyclone_xml(const BusConfig& config, int hub) {
  std::string xml =
      "<CycloneDDS><Domain Id=\"any\">" + general(config) + discovery(config, hub) + internals();
  if (!config.security.empty()) xml += security(config.security);
  xml += "</Domain></CycloneDDS>";
  // After a comma Cyclone DDS reads another document, whose settings replace those before.
  if (!config.cyclone_settings.empty()) xml += "," + config.cyclone_settings;
  return xml;
}

}  // namespace rave::bus
