// SPDX-License-Identifier: Apache-2.0
// Which processes are in the domain, by what they announce of themselves, and which of them are
// lost.
#include "participants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <utility>

#include "rave/base/control_characters.hpp"
#include "rave/bus/endpoint.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {
namespace {

/// The user data of RAVE participants: this word, the run and the writer id in hexadecimal.
constexpr std::string_view kIdentityMark = "rave1 ";
constexpr std::size_t kRunDigits = 32;
constexpr std::size_t kWriterDigits = 16;
/// Limit of remembered names of lost processes.
constexpr std::size_t kMostGone = 1000;

std::array<std::uint8_t, 16> key_of(const dds_guid_t& guid) { return std::to_array(guid.v); }

struct DdsFree {
  void operator()(void* memory) const noexcept { dds_free(memory); }
};

/// Calls visit(const Sample&, const dds_sample_info_t&) for all new samples of a built-in topic.
template <class Sample, class Visit>
void take_all(dds_entity_t reader, Visit&& visit) {
  constexpr std::size_t kBatch = 32;
  while (true) {
    std::array<void*, kBatch> samples{};
    std::array<dds_sample_info_t, kBatch> infos{};
    const dds_return_t count =
        dds_take(reader, samples.data(), infos.data(), kBatch, std::uint32_t{kBatch});
    if (count <= 0) return;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      visit(*static_cast<const Sample*>(samples[i]), infos[i]);
    }
    dds_return_loan(reader, samples.data(), count);
  }
}

}  // namespace

void write_identity(const Identity& identity, dds_qos_t* qos) {
  const std::string data =
      fmt::format("{}{}{:016x}", kIdentityMark, identity.run.text(), identity.writer);
  dds_qset_userdata(qos, data.data(), data.size());
  dds_qset_entity_name(qos, identity.name.c_str());
}

Identity read_identity(const dds_qos_t* qos) {
  Identity identity;
  char* name = nullptr;
  if (dds_qget_entity_name(qos, &name) && name != nullptr) {
    const std::unique_ptr<char, DdsFree> owner(name);
    // Names come from the network and are shown to people.
    identity.name = without_control_characters(std::string_view(name).substr(0, 256), "?");
  }
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return identity;
  const std::unique_ptr<void, DdsFree> owner(data);
  const std::string_view text(static_cast<const char*>(data), size);
  if (size != kIdentityMark.size() + kRunDigits + kWriterDigits ||
      !text.starts_with(kIdentityMark)) {
    return identity;
  }
  const std::string_view writer = text.substr(kIdentityMark.size() + kRunDigits);
  if (const auto run = RunId::parse(text.substr(kIdentityMark.size(), kRunDigits))) {
    std::from_chars(writer.data(), writer.data() + writer.size(), identity.writer, 16);
    identity.run = *run;
  }
  return identity;
}

Participants::Participants(dds_entity_t participant, const LifeSignEnds& sign,
                           const BusConfig& config)
    : run_(config.run),
      all_runs_(config.all_runs),
      secured_(!config.security.empty()),
      lease_(config.lease),
      // Every process sends at least each 0.8 leases, so after a standstill of a fifth of a lease
      // others may count as lost. They, and processes that lost this one, need time to be
      // discovered again.
      life_sign_(sign),
      standstill_({lease_.ns / 5}, lease_ * 3) {
  readers_.push_back(
      dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr));
  readers_.push_back(life_sign_.reader);
  dds_set_status_mask(life_sign_.reader, DDS_LIVELINESS_CHANGED_STATUS);
  if (secured_) {
    readers_.push_back(
        dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, nullptr));
  }
  dds_guid_t guid{};
  dds_get_guid(participant, &guid);
  self_ = key_of(guid);
  beat();
}

std::map<Participants::Guid, Identity> Participants::take_writers() const {
  std::map<Guid, Identity> said;
  if (!secured_) return said;
  take_all<dds_builtintopic_endpoint_t>(
      readers_.back(), [&said](const dds_builtintopic_endpoint_t& sample, const auto& info) {
        if (!info.valid_data) return;
        const Identity who = read_identity(sample.qos);
        if (who.writer != 0) said.try_emplace(key_of(sample.participant_key), who);
      });
  return said;
}

void Participants::beat() {
  const auto now = Standstill::Clock::now();
  if (life_sign_.writer <= 0 || now - last_beat_ < std::chrono::nanoseconds(lease_.ns)) return;
  last_beat_ = now;
  LifeSign sign{};
  std::ranges::copy(run_.bytes, sign.run);
  sign.writer = life_sign_.number;
  // If it cannot be sent, the next one will be.
  static_cast<void>(dds_write(life_sign_.writer, &sign));
}

void Participants::take_life_signs(std::vector<BusEvent>& events) {
  take_all<LifeSign>(life_sign_.reader, [this, &events](const LifeSign& sign, const auto& info) {
    if (!run_.equals(sign.run)) return;
    if (info.instance_state == DDS_ALIVE_INSTANCE_STATE) {
      heard_.insert(sign.writer);
      come_back(sign.writer, events);
    } else {
      fall_silent(sign.writer);
    }
  });
  dds_liveliness_changed_status_t status{};
  dds_get_liveliness_changed_status(life_sign_.reader, &status);
  if (status.not_alive_count_change > 0) suspect_the_new();
}

// A process that is suspected without reason is back with its first sign.
void Participants::suspect_the_new() {
  for (const dds_instance_handle_t handle : matched(life_sign_.reader, true)) {
    const auto known = known_.find(key_of(participant_of(life_sign_.reader, true, handle)));
    if (known == known_.end() || heard_.contains(known->second.writer)) continue;
    fall_silent(known->second.writer);
  }
}

void Participants::fall_silent(std::uint64_t writer) {
  const dds_guid_t* const owner = owner_of(writer);
  if (owner == nullptr) return;
  const dds_guid_t guid = *owner;
  silent_.insert(key_of(guid));
  ++silences_;
  disappear(guid);
}

void Participants::come_back(std::uint64_t writer, std::vector<BusEvent>& events) {
  const auto back = std::ranges::find_if(silent_, [&](const Guid& key) {
    const auto who = gone_.find(key);
    return who != gone_.end() && who->second.writer == writer;
  });
  if (back == silent_.end()) return;
  const Guid key = *back;
  silent_.erase(back);
  ++silences_;
  const Identity who = gone_.extract(key).mapped();
  dds_guid_t& guid = returned_.emplace_back();
  std::ranges::copy(key, guid.v);
  learn(key, who, events);
}

void Participants::collect(std::vector<BusEvent>& events) {
  beat();
  // A participant is announced before its writers, so the participant of a known writer is known.
  const std::map<Guid, Identity> said = take_writers();
  take_all<dds_builtintopic_participant_t>(
      readers_.front(),
      [this, &events](const dds_builtintopic_participant_t& sample, const auto& info) {
        // A participant that appeared and left since the last call has one sample for both.
        if (info.valid_data) appear(sample, events);
        if (info.instance_state == DDS_ALIVE_INSTANCE_STATE) return;
        silent_.erase(key_of(sample.key));
        disappear(sample.key);
      });
  for (const auto& [key, who] : said) {
    const auto known = known_.find(key);
    if (known == known_.end() || known->second.writer != 0) continue;
    learn(key, who, events);
  }
  take_life_signs(events);
  judge(events);
}

/// Reports lost participants, unless this process stood still.
void Participants::judge(std::vector<BusEvent>& events) {
  // Checked after reading, because participants lost through a standstill are read after it. The
  // time before the look: after it this process may stand still again.
  const auto now = Standstill::Clock::now();
  standstill_.look();
  if (now < standstill_.silence_counts_from()) {
    // Others may have lost this process even if it has received from them again.
    const bool long_enough = 2 * standstill_.stood().ns > lease_.ns;
    if ((missed_.empty() && !long_enough) || std::exchange(told_, true)) return;
    events.push_back({EventKind::kStoodStill, "", "", 0,
                      fmt::format("this process, for {:.1f} s; it searches for the others again",
                                  standstill_.stood().seconds())});
    return;
  }
  told_ = false;
  // Losses are reported late, after a standstill of this process could have been noticed: it may be
  // this one that was away.
  for (const auto& [key, who] : missed_) {
    events.push_back({EventKind::kParticipantLost, "", who.name, who.writer, ""});
  }
  missed_.clear();
}

void Participants::appear(const dds_builtintopic_participant_t& sample,
                          std::vector<BusEvent>& events) {
  const Guid key = key_of(sample.key);
  if (key == self_ || known_.contains(key)) return;
  learn(key, secured_ ? Identity() : read_identity(sample.qos), events);
}

void Participants::learn(const Guid& key, const Identity& who, std::vector<BusEvent>& events) {
  known_[key] = who;
  if (who.writer != 0 && ours(who)) {
    dds_guid_t guid{};
    std::ranges::copy(key, guid.v);
    owners_.try_emplace(who.writer, guid);
  }
  // It was found again before its loss was reported.
  if (missed_.erase(key) > 0) return;
  if (!foreign(who)) {
    events.push_back({EventKind::kParticipantAppeared, "", who.name, who.writer, ""});
    return;
  }
  // One event per foreign run, which may have many processes.
  if (foreign_told_.size() >= kMostGone || !foreign_told_.insert(who.run.text()).second) return;
  events.push_back({EventKind::kForeignRun, "", who.name, who.writer,
                    "a process of run " + who.run.text() + " is in this domain"});
}

void Participants::disappear(const dds_guid_t& guid) {
  auto node = known_.extract(key_of(guid));
  if (node.empty()) return;
  const std::uint64_t writer = node.mapped().writer;
  heard_.erase(writer);
  if (!foreign(node.mapped())) missed_.insert({node.key(), node.mapped()});
  const auto owner = owners_.find(writer);
  if (owner != owners_.end() && key_of(owner->second) == node.key()) {
    owners_.erase(owner);
    // Another participant may have claimed the same id before.
    for (const auto& [key, who] : known_) {
      if (who.writer != writer || !ours(who)) continue;
      std::ranges::copy(key, owners_[writer].v);
      break;
    }
  }
  // Names of the lost are kept, because events of their readers and writers may come later.
  if (gone_.size() >= kMostGone) gone_.erase(gone_.begin());
  gone_.insert(std::move(node));
}

const dds_guid_t* Participants::owner_of(std::uint64_t writer) const {
  const auto owner = owners_.find(writer);
  return owner == owners_.end() ? nullptr : &owner->second;
}

// An id that no participant has announced protects none.
bool Participants::speaks_for(const dds_guid_t& guid, std::uint64_t writer) const {
  const dds_guid_t* const owner = owner_of(writer);
  return owner == nullptr || key_of(*owner) == key_of(guid);
}

bool Participants::foreign(const Identity& who) const { return !who.run.none() && !ours(who); }

Identity Participants::find(const dds_guid_t& guid) const {
  const Guid key = key_of(guid);
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  if (const auto gone = gone_.find(key); gone != gone_.end()) return gone->second;
  return {};
}

bool Participants::gone(const dds_guid_t& guid) const {
  const Guid key = key_of(guid);
  return gone_.contains(key) && !known_.contains(key);
}

std::vector<BusProcess> Participants::all() const {
  std::vector<BusProcess> processes;
  for (const auto& [key, who] : known_) processes.push_back({who.name, who.run, who.writer});
  return processes;
}

}  // namespace rave::bus
