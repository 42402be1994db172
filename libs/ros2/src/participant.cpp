// SPDX-License-Identifier: Apache-2.0
// A participant in a DDS domain of ROS 2. It needs no ROS 2 installation; names, settings and
// announcements are those of ROS 2 nodes.
#include "rave/ros2/participant.hpp"

#include <arpa/inet.h>
#include <fmt/ranges.h>
#include <ifaddrs.h>

#include <algorithm>
#include <array>

#include "make_end.hpp"
#include "rave/base/names.hpp"
#include "rave/ros2/names.hpp"

namespace rave::ros2 {
namespace {

/// Domain numbers of these participants within this process; those of the bus are 0 to 230.
constexpr std::uint32_t kFirstDomain = 1000;
constexpr std::uint32_t kMostDomains = 1000;
/// As for ROS 2 nodes on Cyclone DDS: a network may be interrupted for a while. Silent topics
/// reveal a lost participant earlier.
constexpr Duration kLease{10'000'000'000};
/// As for a ROS 2 participant without security.
constexpr std::string_view kEnclave = "enclave=/;";
/// Limit of names in a message.
constexpr std::size_t kMostNamed = 5;

/// Addresses and names of the interfaces of this machine.
std::vector<std::string> interfaces_here() {
  std::vector<std::string> found;
  ifaddrs* list = nullptr;
  if (::getifaddrs(&list) != 0) return found;
  for (const ifaddrs* each = list; each != nullptr; each = each->ifa_next) {
    if (each->ifa_addr == nullptr || each->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = {};
    const auto* const address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
    if (::inet_ntop(AF_INET, &address->sin_addr, text, sizeof text) != nullptr) {
      found.emplace_back(text);
    }
    found.emplace_back(each->ifa_name);
  }
  ::freeifaddrs(list);
  return found;
}

Status check_interface(const Network& network) {
  const std::vector<std::string> here = interfaces_here();
  // Any address of the loopback network belongs to this machine.
  if (here.empty() || network.interface.empty() || network.interface.starts_with("127.")) return {};
  if (std::ranges::find(here, network.interface) != here.end()) return {};
  const std::vector<std::string_view> names(here.begin(), here.end());
  return fail(ErrorCode::kInvalidArgument, "interface: this machine has no `{}`{}",
              network.interface, suggestion(network.interface, names));
}

bus::BusConfig config_of(const Network& network) {
  bus::BusConfig config;
  config.participant = network.name;
  // irrelevant to ROS 2, but the configuration check requires one
  config.run = bus::RunId::random();
  config.domain = network.domain;
  config.interface = network.interface;
  config.peers = network.peers;
  config.multicast = network.multicast;
  config.lease = config.forget = kLease;
  // This is the domain number on the network; the number in this process is another one.
  config.cyclone_settings = fmt::format(
      "<CycloneDDS><Domain Id=\"any\"><Discovery><ExternalDomainId>{}</ExternalDomainId>"
      "<SPDPInterval>2s</SPDPInterval></Discovery></Domain></CycloneDDS>",
      network.domain);
  return config;
}

/// Whether this process has a Cyclone DDS domain; its owner receives the log.
bool has_domains() { return dds_get_children(DDS_CYCLONEDDS_HANDLE, nullptr, 0) > 0; }

/// Calls `visit(const Sample&)` for all live samples of a built-in topic.
template <class Sample, class Visit>
void look_at(dds_entity_t reader, Visit&& visit) {
  constexpr std::size_t kMost = 1000;
  std::vector<void*> samples(kMost, nullptr);
  std::vector<dds_sample_info_t> infos(kMost);
  const dds_return_t count =
      dds_read_mask(reader, samples.data(), infos.data(), kMost, std::uint32_t{kMost},
                    DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ALIVE_INSTANCE_STATE);
  if (count <= 0) return;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (infos[i].valid_data) visit(*static_cast<const Sample*>(samples[i]));
  }
  dds_return_loan(reader, samples.data(), count);
}

std::string named(const std::vector<std::string>& names) {
  const std::vector<std::string_view> first(
      names.begin(),
      names.begin() + static_cast<std::ptrdiff_t>(std::min(names.size(), kMostNamed)));
  return join_names(first);
}

}  // namespace

std::string text_of(const RemoteId& id) {
  const std::string gid = fmt::format("GID {:02x}", fmt::join(id.guid, "."));
  return id.name.empty() ? gid : fmt::format("`{}` ({})", id.name, gid);
}

Result<std::unique_ptr<Participant>> Participant::open(const Network& network) {
  RAVE_TRY(check_interface(network));
  RAVE_TRY(bus::validate(config_of(network)));
  std::unique_ptr<Participant> participant(new Participant(network));
  RAVE_TRY(participant->join());
  return participant;
}

Status Participant::join() {
  if (!has_domains()) log_ = std::make_unique<bus::CycloneLog>();
  const std::string settings = bus::cyclone_xml(config_of(network_));
  std::uint32_t number = kFirstDomain;
  // Numbers within this process only: several participants, and the bus, may use one domain of the
  // network.
  do {
    domain_ = dds_create_domain(number, settings.c_str());
  } while (domain_ == DDS_RETCODE_PRECONDITION_NOT_MET && ++number < kFirstDomain + kMostDomains);
  const auto refused = [this](dds_return_t code) {
    std::string reason(dds_strretcode(code));
    for (const std::string& line : log_ ? log_->take() : std::vector<std::string>()) {
      reason += "; " + line;
    }
    return fail(ErrorCode::kIo, "cannot join domain {} of ROS 2 at {}: {}", network_.domain,
                network_.interface, reason);
  };
  if (domain_ < 0) return refused(domain_);
  const bus::Qos qos(dds_create_qos());
  dds_qset_entity_name(qos.get(), network_.name.c_str());
  // ROS 2 distinguishes its nodes from other DDS participants by this.
  dds_qset_userdata(qos.get(), kEnclave.data(), kEnclave.size());
  participant_ = dds_create_participant(number, qos.get(), nullptr);
  if (participant_ < 0) return refused(participant_);
  const auto builtin = [this](dds_entity_t topic) {
    return dds_create_reader(participant_, topic, nullptr, nullptr);
  };
  seen_participants_ = builtin(DDS_BUILTIN_TOPIC_DCPSPARTICIPANT);
  seen_writers_ = builtin(DDS_BUILTIN_TOPIC_DCPSPUBLICATION);
  seen_readers_ = builtin(DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION);
  const dds_entity_t worst = std::min({seen_participants_, seen_writers_, seen_readers_});
  if (worst < 0) return refused(worst);
  if (network_.nodes == NodeForm::kNone) return {};
  RAVE_TRY_ASSIGN(const std::string home, whole_name(network_.node_namespace, network_.node));
  std::string above = home.substr(0, home.rfind('/'));
  if (above.empty()) above = "/";
  RAVE_TRY_ASSIGN(nodes_, NodeList::open(participant_, network_.nodes,
                                         home.substr(home.rfind('/') + 1), std::move(above)));
  return {};
}

Participant::~Participant() {
  nodes_.reset();
  // Deletes everything in the domain too.
  if (domain_ > 0) dds_delete(domain_);
}

Result<dds_entity_t> Participant::add_end(const dds_topic_descriptor_t& type,
                                          std::string_view topic, const bus::QosProfile& profile,
                                          bool reads) const {
  RAVE_TRY_ASSIGN(const dds_entity_t end,
                  make_end(participant_, type, wire_topic(topic), profile, reads));
  if (nodes_) nodes_->add(end, reads);
  return end;
}

void Participant::remove_end(dds_entity_t end) const {
  if (nodes_) nodes_->remove(end);
  dds_delete(end);
}

void Participant::announce() const {
  if (nodes_) nodes_->announce();
}

std::vector<RemoteEnd> Participant::others(bool writers) const {
  dds_guid_t self{};
  dds_get_guid(participant_, &self);
  std::vector<RemoteEnd> ends;
  look_at<dds_builtintopic_endpoint_t>(
      writers ? seen_writers_ : seen_readers_, [&](const dds_builtintopic_endpoint_t& end) {
        if (std::ranges::equal(end.participant_key.v, self.v)) return;
        ends.push_back({topic_of_wire(end.topic_name), type_of_wire(end.type_name)});
      });
  return ends;
}

std::string Participant::name_of(const RemoteId::Guid& participant) const {
  std::string found;
  look_at<dds_builtintopic_participant_t>(seen_participants_,
                                          [&](const dds_builtintopic_participant_t& other) {
                                            char* name = nullptr;
                                            if (!std::ranges::equal(other.key.v, participant))
                                              return;
                                            if (dds_qget_entity_name(other.qos, &name))
                                              found = name;
                                            dds_free(name);
                                          });
  // That of every process of ROS 2 on Fast DDS.
  return found == "/" ? std::string() : found;
}

std::size_t Participant::others_here() const {
  std::size_t count = 0;
  look_at<dds_builtintopic_participant_t>(seen_participants_,
                                          [&](const dds_builtintopic_participant_t&) { ++count; });
  return count > 0 ? count - 1 : 0;  // minus this participant
}

std::string Participant::explain_silence(std::string_view topic, std::string_view type,
                                         bool writers) const {
  const std::string wanted = type_of_wire(type);
  const char* const does = writers ? "writes" : "reads";
  // From the general to the particular: no other participant, this topic with another type, this
  // type at another topic.
  if (others_here() == 0) {
    return fmt::format(
        "no other participant is in domain {} at {}; compare ROS_DOMAIN_ID, `interface`, "
        "`multicast` and "
        "`peers`",
        network_.domain, network_.interface);
  }
  std::vector<std::string> elsewhere;
  for (const RemoteEnd& end : others(writers)) {
    if (end.topic == topic && end.type == wanted) {
      return fmt::format("another participant {} `{}`, but no message came", does, topic);
    }
    if (end.topic == topic) {
      return fmt::format("topic `{}` has the type {}; expected {}", topic, end.type, wanted);
    }
    const bool told = std::ranges::find(elsewhere, end.topic) != elsewhere.end();
    if (end.type == wanted && !told) elsewhere.push_back(end.topic);
  }
  if (!elsewhere.empty()) {
    return fmt::format("no participant {} `{}`; the type {} is at {}", does, topic, wanted,
                       named(elsewhere));
  }
  return fmt::format("no participant {} `{}`, nor the type {} elsewhere", does, topic, wanted);
}

}  // namespace rave::ros2
