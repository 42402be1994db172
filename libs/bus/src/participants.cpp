// SPDX-License-Identifier: Apache-2.0
#include "participants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <utility>

#include "rave/base/control_characters.hpp"

namespace rave::bus {
namespace {

/// The user data of our participants: this word, the run and the writer, in hexadecimal digits.
constexpr std::string_view kMark = "rave1 ";
constexpr std::size_t kRunDigits = 32;
constexpr std::size_t kWriterDigits = 16;
/// More names of processes that have gone are not kept.
constexpr std::size_t kMostGone = 1000;

std::array<std::uint8_t, 16> key_of(const dds_guid_t& guid) { return std::to_array(guid.v); }

struct DdsFree {
  void operator()(void* memory) const noexcept { dds_free(memory); }
};

}  // namespace

void write_identity(const Identity& identity, dds_qos_t* qos) {
  const std::string data = fmt::format("{}{}{:016x}", kMark, identity.run.text(), identity.writer);
  dds_qset_userdata(qos, data.data(), data.size());
  dds_qset_entity_name(qos, identity.name.c_str());
}

Identity read_identity(const dds_qos_t* qos) {
  Identity identity;
  char* name = nullptr;
  if (dds_qget_entity_name(qos, &name) && name != nullptr) {
    const std::unique_ptr<char, DdsFree> owner(name);
    // It is shown to people, and comes from anybody.
    identity.name = without_control_characters(std::string_view(name).substr(0, 256), "?");
  }
  void* data = nullptr;
  std::size_t size = 0;
  if (!dds_qget_userdata(qos, &data, &size) || data == nullptr) return identity;
  const std::unique_ptr<void, DdsFree> owner(data);
  const std::string_view text(static_cast<const char*>(data), size);
  if (size != kMark.size() + kRunDigits + kWriterDigits || !text.starts_with(kMark)) {
    return identity;
  }
  const std::string_view writer = text.substr(kMark.size() + kRunDigits);
  if (const auto run = RunId::parse(text.substr(kMark.size(), kRunDigits))) {
    std::from_chars(writer.data(), writer.data() + writer.size(), identity.writer, 16);
    identity.run = *run;
  }
  return identity;
}

Participants::Participants(dds_entity_t participant, const RunId& run, Duration lease)
    : run_(run),
      reader_(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPARTICIPANT, nullptr, nullptr)),
      // A process is heard of each 0.8 leases at least, so a fifth without us may lose it. Those
      // that have lost us as well must be found again.
      standstill_({lease.ns / 5}, lease * 3) {
  dds_guid_t guid{};
  dds_get_guid(participant, &guid);
  self_ = key_of(guid);
}

void Participants::collect(std::vector<BusEvent>& events) {
  constexpr std::size_t kBatch = 32;
  while (true) {
    std::array<void*, kBatch> samples{};
    std::array<dds_sample_info_t, kBatch> infos{};
    const dds_return_t count =
        dds_take(reader_, samples.data(), infos.data(), kBatch, std::uint32_t{kBatch});
    if (count <= 0) break;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto& sample = *static_cast<const dds_builtintopic_participant_t*>(samples[i]);
      // Who came and went since the last time has one sample that says both.
      if (infos[i].valid_data) appear(sample, events);
      if (infos[i].instance_state != DDS_ALIVE_INSTANCE_STATE) disappear(sample.key);
    }
    dds_return_loan(reader_, samples.data(), count);
  }
  judge(events);
}

/// Tells who is gone, unless it is this process that was.
void Participants::judge(std::vector<BusEvent>& events) {
  // Not before: whoever is missed because of a standstill has been read after it.
  standstill_.look();
  if (missed_.empty()) told_ = false;
  if (missed_.empty()) return;
  if (Standstill::Clock::now() < standstill_.silence_counts_from()) {
    if (std::exchange(told_, true)) return;
    events.push_back({EventKind::kStoodStill, "", "", 0,
                      fmt::format("this process, for {:.1f} s; who else is there is found out anew",
                                  standstill_.stood().seconds())});
    return;
  }
  told_ = false;
  for (const auto& [key, who] : missed_) {
    events.push_back({EventKind::kParticipantLost, "", who.name, who.writer, ""});
  }
  missed_.clear();
}

void Participants::appear(const dds_builtintopic_participant_t& sample,
                          std::vector<BusEvent>& events) {
  const Guid key = key_of(sample.key);
  if (key == self_ || known_.contains(key)) return;
  const Identity& who = known_[key] = read_identity(sample.qos);
  if (missed_.erase(key) > 0) return;
  if (foreign(who)) {
    events.push_back({EventKind::kForeignRun, "", who.name, who.writer,
                      "a process of run " + who.run.text() + " is in this domain"});
  } else {
    events.push_back({EventKind::kParticipantAppeared, "", who.name, who.writer, ""});
  }
}

void Participants::disappear(const dds_guid_t& guid) {
  auto node = known_.extract(key_of(guid));
  if (node.empty()) return;
  if (!foreign(node.mapped())) missed_.insert({node.key(), node.mapped()});
  if (gone_.size() >= kMostGone) gone_.erase(gone_.begin());
  gone_.insert(std::move(node));
}

bool Participants::foreign(const Identity& who) const { return !who.run.none() && who.run != run_; }

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
