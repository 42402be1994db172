// SPDX-License-Identifier: Apache-2.0
// A member of a DDS domain: its participant, the partitions of its run, and what happens to
// readers, writers and processes, as events.
#include "rave/bus/bus.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>
#include <utility>

#include "participants.hpp"
#include "rave/bus/cyclone_log.hpp"
#include "rave/bus/endpoint.hpp"
#include "rave/bus/local_transport.hpp"

namespace rave::bus {
namespace {

/// Domain numbers within this process for buses with `beside`; they do not affect ports. They start
/// above the range of other buses. DDS Security checks permissions with this number, which are
/// granted for 0 to 230, so with security the highest free number in that range is used.
constexpr std::uint32_t kFirstBeside = 5000;
constexpr std::uint32_t kMostBeside = 200;
constexpr std::uint32_t kHighestSecured = 230;

std::uint32_t number_beside(const BusConfig& config, std::uint32_t attempt) {
  return config.security.empty() ? kFirstBeside + attempt : kHighestSecured - attempt;
}

constexpr std::uint32_t kReaderStatus =
    DDS_SUBSCRIPTION_MATCHED_STATUS | DDS_REQUESTED_INCOMPATIBLE_QOS_STATUS;
constexpr std::uint32_t kWriterStatus =
    DDS_PUBLICATION_MATCHED_STATUS | DDS_OFFERED_INCOMPATIBLE_QOS_STATUS;

// Hosts are in both partitions, the manager and monitors in one each. So both match hosts, and
// never each other.
Qos partitions_of(const RunId& run, Side side, bool all_runs) {
  Qos qos(dds_create_qos());
  if (all_runs) {
    const char* any = side == Side::kMonitor ? "rave/*/hosts" : "rave/*";
    dds_qset_partition(qos.get(), 1, &any);
    return qos;
  }
  const std::string run_itself = "rave/" + run.text();
  const std::string hosts = run_itself + "/hosts";
  std::vector<const char*> names;
  if (side != Side::kMonitor) names.push_back(run_itself.c_str());
  if (side != Side::kManager) names.push_back(hosts.c_str());
  dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
  return qos;
}

/// The writer id that the matched reader or writer announces.
std::uint64_t writer_of(dds_entity_t entity, bool reads, dds_instance_handle_t handle,
                        const RunId& run, const Participants& participants) {
  const auto data_of = reads ? dds_get_matched_publication_data : dds_get_matched_subscription_data;
  dds_builtintopic_endpoint_t* const data = data_of(entity, handle);
  if (data == nullptr) return 0;
  const Identity who = read_identity(data->qos);
  // Endpoints remain visible for a while after their participant is lost.
  const bool lost = participants.gone(data->participant_key);
  dds_builtintopic_free_endpoint(data);
  if (lost) return kGoneProcess;
  return who.run == run ? who.writer : 0;
}

/// Whether this process has a domain; its owner receives the log of Cyclone DDS.
bool has_domains() { return dds_get_children(DDS_CYCLONEDDS_HANDLE, nullptr, 0) > 0; }

}  // namespace

Bus::Bus(BusConfig config)
    : config_(std::move(config)), writer_(random_writer_id()), number_(config_.domain) {
  // Cyclone DDS has one log per process; the first bus gets it.
  if (!config_.beside || !has_domains()) log_ = std::make_unique<CycloneLog>();
}

Result<std::unique_ptr<Bus>> Bus::open(const BusConfig& config) {
  RAVE_TRY(validate(config));
  std::unique_ptr<Bus> bus(new Bus(config));
  RAVE_TRY(bus->open_domain());
  RAVE_TRY(bus->open_participant());
  return bus;
}

Status Bus::open_domain() {
  if (config_.reach == Reach::kHub) return open_hub();
  const std::string settings = cyclone_xml(config_);
  std::uint32_t attempt = 0;
  // A second bus of one process needs a domain number of its own in Cyclone DDS, which is used
  // inside this process only.
  do {
    if (config_.beside) number_ = number_beside(config_, attempt);
    domain_ = dds_create_domain(number_, settings.c_str());
  } while (config_.beside && domain_ == DDS_RETCODE_PRECONDITION_NOT_MET &&
           ++attempt < kMostBeside);
  if (domain_ < 0) return refused(domain_);
  return {};
}

/// Uses the first reserved port that no other hub of this machine has.
Status Bus::open_hub() {
  for (int hub = 0; hub < BusConfig::kMostHubs; ++hub) {
    domain_ = dds_create_domain(number_, cyclone_xml(config_, hub).c_str());
    if (domain_ == DDS_RETCODE_PRECONDITION_NOT_MET) break;
    if (domain_ < 0) continue;
    // Drop the log lines about ports in use.
    if (log_) static_cast<void>(log_->take());
    return {};
  }
  return refused(domain_);
}

Status Bus::open_participant() {
  const Qos qos(dds_create_qos());
  // Announcements of participants are never encrypted; members announce themselves through a writer
  // instead.
  const bool secured = !config_.security.empty();
  if (secured) {
    // Cyclone DDS announces these properties of every process unless they are set.
    for (const char* const name : {"__ProcessName", "__Pid", "__Hostname"}) {
      dds_qset_prop(qos.get(), name, "");
    }
  } else if (config_.anonymous) {
    dds_qset_entity_name(qos.get(), config_.participant.c_str());
  } else {
    write_identity({config_.participant, config_.run, writer_}, qos.get());
  }
  participant_ = dds_create_participant(number_, qos.get(), nullptr);
  if (participant_ < 0) return refused(participant_);
  const Qos partition = partitions_of(config_.run, config_.side, config_.all_runs);
  publisher_ = dds_create_publisher(participant_, partition.get(), nullptr);
  subscriber_ = dds_create_subscriber(participant_, partition.get(), nullptr);
  RAVE_TRY_ASSIGN(const LifeSignEnds sign, open_life_sign());
  participants_ = std::make_unique<Participants>(participant_, sign, config_);
  const dds_return_t worst =
      std::min({publisher_, subscriber_, sign.writer, std::ranges::min(participants_->readers()),
                dds_entity_t{0}});
  if (worst < 0) return refused(worst);
  // The local transport is not encrypted, so it must not be used with certificates.
  if (config_.local_transport && !config_.anonymous && !secured) {
    if (auto socket = LocalSocket::open({config_.run, writer_, 0})) {
      local_transport_ = std::make_unique<LocalSocket>(*std::move(socket));
    }
  }
  return {};
}

Result<LifeSignEnds> Bus::open_life_sign() {
  const TopicSpec spec = topic_of<LifeSign>();
  RAVE_TRY_ASSIGN(const dds_entity_t topic, make_topic(spec));
  const Qos qos = make_qos(spec.qos);
  LifeSignEnds ends{dds_create_reader(subscriber_, topic, qos.get(), nullptr), 0, writer_};
  if (!config_.anonymous) {
    write_identity({config_.participant, config_.run, writer_}, qos.get());
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, config_.lease.ns);
    ends.writer = dds_create_writer(publisher_, topic, qos.get(), nullptr);
  }
  dds_delete(topic);
  return ends;
}

tl::unexpected<Error> Bus::refused(dds_return_t code) {
  if (code == DDS_RETCODE_PRECONDITION_NOT_MET) {
    return fail(ErrorCode::kState, "this process already has a bus in domain {}", config_.domain);
  }
  std::string reason(dds_strretcode(code));
  if (log_) {
    for (const std::string& line : log_->take()) reason += "; " + line;
  }
  return fail(ErrorCode::kIo, "cannot join domain {} at {}: {}", config_.domain, config_.interface,
              reason);
}

Bus::~Bus() {
  // Deletes everything in the domain too.
  if (domain_ > 0) dds_delete(domain_);
}

Result<dds_entity_t> Bus::make_topic(const TopicSpec& spec) {
  const Qos qos = make_qos(spec.qos);
  const dds_entity_t topic =
      dds_create_topic(participant_, spec.type, spec.name, qos.get(), nullptr);
  if (topic < 0) {
    return fail(ErrorCode::kState, "topic {}: {}", spec.name, dds_strretcode(topic));
  }
  return topic;
}

Result<dds_entity_t> Bus::add_endpoint(const TopicSpec& topic, bool reads) {
  RAVE_TRY_ASSIGN(const dds_entity_t handle, make_topic(topic));
  const Qos qos = make_qos(topic.qos);
  Endpoint endpoint;
  endpoint.reads = reads;
  endpoint.topic = topic.name;
  endpoint.recalls = reads && topic.qos.recalls;
  open_local_transport(endpoint, topic);
  // A reader without a socket does not announce its process: the address could belong to another
  // reader.
  if (topic.local_transport != 0 && !config_.anonymous && (!reads || endpoint.receiver)) {
    write_identity({config_.participant, config_.run, writer_}, qos.get());
  }
  const dds_entity_t entity = reads ? dds_create_reader(subscriber_, handle, qos.get(), nullptr)
                                    : dds_create_writer(publisher_, handle, qos.get(), nullptr);
  // The endpoint keeps a reference to the topic.
  dds_delete(handle);
  if (entity < 0) {
    return fail(ErrorCode::kIo, "cannot {} {}: {}", reads ? "read" : "write", topic.name,
                dds_strretcode(entity));
  }
  // Only these statuses wake a wait set; data have a condition of their own.
  dds_set_status_mask(entity, reads ? kReaderStatus : kWriterStatus);
  endpoint.entity = entity;
  endpoints_.push_back(std::move(endpoint));
  return entity;
}

void Bus::open_local_transport(Endpoint& endpoint, const TopicSpec& topic) {
  if (local_transport_ == nullptr || topic.local_transport == 0) return;
  if (!endpoint.reads) {
    endpoint.sender =
        std::make_unique<LocalSender>(topic, config_.run, local_transport_->descriptor());
    return;
  }
  // A second reader of the topic in this process gets no socket; writers see two readers and use
  // DDS.
  if (auto socket = LocalSocket::open({config_.run, writer_, topic.local_transport})) {
    endpoint.receiver = std::make_unique<LocalReceiver>(topic, config_.run, *std::move(socket));
  }
}

Bus::Endpoint* Bus::endpoint(dds_entity_t entity) {
  const auto found = std::ranges::find(endpoints_, entity, &Endpoint::entity);
  return found == endpoints_.end() ? nullptr : &*found;
}

void Bus::meet(Endpoint& endpoint) {
  if (!endpoint.sender && !endpoint.receiver) return;
  std::vector<std::uint64_t> writers;
  for (const dds_instance_handle_t handle : matched(endpoint.entity, endpoint.reads)) {
    writers.push_back(
        writer_of(endpoint.entity, endpoint.reads, handle, config_.run, *participants_));
  }
  if (endpoint.receiver) endpoint.receiver->meet(writers);
  if (endpoint.sender) endpoint.sender->meet(std::move(writers));
}

Status Bus::await_arrival(dds_entity_t writer, Duration patience) {
  using Clock = Standstill::Clock;
  // How often it looks whether the readers are still alive.
  constexpr std::chrono::milliseconds kLook{50};
  const auto end = Clock::now() + std::chrono::nanoseconds(patience.ns);
  // It looks before it waits: none waits for readers that are known to be lost.
  for (std::chrono::nanoseconds wait{0};; wait = kLook) {
    const std::chrono::nanoseconds left = end - Clock::now();
    const dds_return_t code =
        dds_wait_for_acks(writer, std::clamp<std::int64_t>(left.count(), 0, wait.count()));
    if (code == DDS_RETCODE_OK) return {};
    if (code != DDS_RETCODE_TIMEOUT) return fail(ErrorCode::kIo, "{}", dds_strretcode(code));
    participants_->collect(events_);
    const auto readers = matched(writer, false);
    if (std::ranges::all_of(readers, [&](dds_instance_handle_t reader) {
          return participants_->gone(participant_of(writer, false, reader));
        })) {
      return fail(ErrorCode::kState, "all readers are lost");
    }
    if (left.count() <= 0) return fail(ErrorCode::kTimeout, "a reader does not keep up");
  }
}

void Bus::remove_endpoint(dds_entity_t entity) {
  const Endpoint* const end = endpoint(entity);
  if (end != nullptr && !end->reads) {
    const auto began = Standstill::Clock::now();
    // Samples that do not arrive are lost without a word: no caller could do anything about it.
    if (!await_arrival(entity, last_words_)) {
      const std::chrono::nanoseconds waited = Standstill::Clock::now() - began;
      last_words_ = Duration{std::max<std::int64_t>(0, last_words_.ns - waited.count())};
    }
  }
  std::erase_if(endpoints_, [&](const Endpoint& e) { return e.entity == entity; });
  dds_delete(entity);
}

std::vector<BusEvent> Bus::take_events() {
  if (log_) {
    for (std::string& line : log_->take()) {
      events_.push_back({EventKind::kNotice, "", "", 0, std::move(line)});
    }
  }
  const std::size_t before = events_.size();
  participants_->collect(events_);
  const std::uint64_t seen = std::exchange(silences_, participants_->silences());
  const bool silence = seen != silences_;
  const std::vector<dds_guid_t> returned = participants_->take_returned();
  for (Endpoint& endpoint : endpoints_) {
    if (endpoint.recalls) {
      endpoint.returned.insert(endpoint.returned.end(), returned.begin(), returned.end());
    }
    collect_incompatible(endpoint);
    collect_matches(endpoint, silence);
  }
  // A participant has come or gone, so addresses of the local transport may have changed.
  if (events_.size() > before) {
    for (Endpoint& endpoint : endpoints_) meet(endpoint);
  }
  return std::exchange(events_, {});
}

std::vector<BusProcess> Bus::processes() const { return participants_->all(); }

bool Bus::speaks_for(dds_entity_t reader, dds_instance_handle_t from, std::uint64_t writer) {
  // Protects from a process that writes the id of another one into its samples: an id belongs to
  // the participant that announced it.
  const dds_guid_t* const owner = participants_->owner_of(writer);
  if (owner == nullptr) return true;
  Endpoint* const end = endpoint(reader);
  if (end == nullptr) return true;
  auto peer = std::ranges::find(end->heard, from, &Endpoint::Peer::handle);
  if (peer != end->heard.end()) return participants_->speaks_for(peer->participant, writer);
  const dds_guid_t participant = participant_of(reader, true, from);
  if (std::ranges::count(participant.v, 0) == std::ssize(participant.v)) {
    // The writer has left. Accept its last samples unless the id belongs to another known writer.
    return std::ranges::none_of(end->heard, [&](const Endpoint::Peer& known) {
      return participants_->speaks_for(known.participant, writer);
    });
  }
  // Bounded, since writers come and go for as long as the process lives; asking DDS again is only
  // slow.
  if (end->heard.size() >= kMaxEvents) end->heard.clear();
  end->heard.push_back({from, participant});
  return participants_->speaks_for(participant, writer);
}

const Standstill& Bus::standstill() const noexcept {
  participants_->standstill().look();
  return participants_->standstill();
}

void Bus::collect_matches(Endpoint& endpoint, bool all) {
  std::uint32_t status = 0;
  dds_take_status(
      endpoint.entity, &status,
      endpoint.reads ? DDS_SUBSCRIPTION_MATCHED_STATUS : DDS_PUBLICATION_MATCHED_STATUS);
  if (status == 0 && !all) return;
  const auto add = [&](const Endpoint::Peer& peer, bool appeared) {
    const Identity who = participants_->find(peer.participant);
    const EventKind reader = appeared ? EventKind::kReaderAppeared : EventKind::kReaderLost;
    const EventKind writer = appeared ? EventKind::kWriterAppeared : EventKind::kWriterLost;
    events_.push_back({endpoint.reads ? writer : reader, endpoint.topic, who.name, who.writer, ""});
  };
  const auto now = matched(endpoint.entity, endpoint.reads);
  std::erase_if(endpoint.peers, [&](const Endpoint::Peer& peer) {
    const bool gone =
        std::ranges::find(now, peer.handle) == now.end() || participants_->gone(peer.participant);
    if (gone) add(peer, false);
    return gone;
  });
  for (const dds_instance_handle_t handle : now) {
    if (std::ranges::find(endpoint.peers, handle, &Endpoint::Peer::handle) != endpoint.peers.end())
      continue;
    const Endpoint::Peer peer{handle, participant_of(endpoint.entity, endpoint.reads, handle)};
    // It may have appeared after the participants were read.
    participants_->collect(events_);
    if (participants_->gone(peer.participant)) continue;
    endpoint.peers.push_back(peer);
    add(peer, true);
  }
}

void Bus::collect_incompatible(const Endpoint& endpoint) {
  // A manager and a monitor of one run do not match each other on purpose.
  const bool all = config_.side == Side::kAll;
  if (auto text = take_mismatch(endpoint.entity, endpoint.reads, all)) {
    events_.push_back({EventKind::kIncompatible, endpoint.topic, "", 0, *std::move(text)});
  }
}

void Bus::note_foreign(const std::string& topic) {
  // One event per thousand: a sender in the wrong partition sends continuously.
  ++foreign_samples_;
  if (foreign_told_++ % kMaxEvents == 0) {
    events_.push_back({EventKind::kForeignRun, topic, "", 0,
                       fmt::format("{} samples of other runs so far", foreign_told_)});
  }
}

void Bus::note_refused(const std::string& topic, std::uint64_t writer, std::string why) {
  ++refused_samples_;
  // Bounded: a faulty sender sends many of them, and the caller may never ask for events.
  if (events_.size() < kMaxEvents) {
    events_.push_back({EventKind::kRefused, topic, "", writer, std::move(why)});
  }
}

}  // namespace rave::bus
