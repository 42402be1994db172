// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "rave/bus/config.hpp"
#include "rave/bus/event.hpp"
#include "rave/bus/topics.hpp"

namespace rave::bus {

class CycloneLog;
class Participants;
class ShortReceiver;
class ShortSender;
class ShortSocket;
class Standstill;

/// Another process in the domain, as it introduces itself. A value.
struct BusProcess {
  std::string name;
  RunId run;                 ///< None: it belongs to no run, or is not of RAVE.
  std::uint64_t writer = 0;  ///< 0 if it has no run.
};

/// This process on the bus: one participant in one run. Writers and readers are made on it and must
/// be gone before it. At most one per process and domain, besides those that are
/// `beside` it.
///
/// Thread: one owner, also for its writers, readers and wait sets; only a stop token may come from
/// another. Cyclone DDS has threads of its own that call nothing of ours.
class Bus {
 public:
  /// Errors: kInvalidArgument (the configuration), kState (this process has a bus in that domain),
  /// kIo (no such interface, no free port, certificates that do not fit).
  [[nodiscard]] static Result<std::unique_ptr<Bus>> open(const BusConfig& config);
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;
  ~Bus();

  [[nodiscard]] const BusConfig& config() const noexcept { return config_; }
  /// The name of this start of this process; the `writer` of all its samples.
  [[nodiscard]] std::uint64_t writer() const noexcept { return writer_; }

  /// What has changed since the last call, oldest first. Call it now and then: at most kMaxEvents
  /// are kept, after which refusals and foreign samples are only counted.
  [[nodiscard]] std::vector<BusEvent> take_events();

  /// The other processes in the domain, of this and of other runs, as of the last take_events().
  [[nodiscard]] std::vector<BusProcess> processes() const;

  /// When this process stood still the last time: who has not been heard of may be there.
  [[nodiscard]] const Standstill& standstill() const noexcept;

  /// How many samples of other runs came by, and by the short way also of strangers.
  [[nodiscard]] std::uint64_t foreign_samples() const noexcept { return foreign_samples_; }
  /// How many samples were refused by validation.
  [[nodiscard]] std::uint64_t refused_samples() const noexcept { return refused_samples_; }

  static constexpr std::size_t kMaxEvents = 1000;

 private:
  friend class WriterCore;
  friend class ReaderCore;
  friend class WaitSet;

  /// A writer or reader of ours and who is at its other end.
  struct Endpoint {
    dds_entity_t entity = 0;
    bool reads = false;
    std::string topic;
    struct Peer {
      dds_instance_handle_t handle = 0;
      dds_guid_t participant{};
    };
    std::vector<Peer> peers;
    std::vector<Peer> heard;  ///< Whose samples have come, with `reads`.
    std::unique_ptr<ShortSender> sender;
    std::unique_ptr<ShortReceiver> receiver;
  };

  explicit Bus(BusConfig config);
  [[nodiscard]] Status open_domain();
  [[nodiscard]] Status open_hub();
  [[nodiscard]] Status open_participant();
  /// Says who this process is with a writer that writes nothing: what is told of it is encrypted.
  [[nodiscard]] Status introduce();
  [[nodiscard]] tl::unexpected<Error> refused(dds_return_t code);
  [[nodiscard]] Result<dds_entity_t> make_topic(const TopicSpec& spec);
  /// Makes a reader or writer of a topic.
  [[nodiscard]] Result<dds_entity_t> add_endpoint(const TopicSpec& topic, bool reads);
  void remove_endpoint(dds_entity_t entity);
  /// That of an entity, until the next one is made; null: there is none.
  [[nodiscard]] Endpoint* endpoint(dds_entity_t entity);
  void open_short_way(Endpoint& endpoint, const TopicSpec& topic);
  /// Tells the short way of an endpoint who is at the other end. Takes no event from anybody.
  void meet(Endpoint& endpoint);
  /// Whether the writer `from`, of which `reader` has a sample, is of the process that has the name
  /// `writer`, as far as that is known.
  [[nodiscard]] bool speaks_for(dds_entity_t reader, dds_instance_handle_t from,
                                std::uint64_t writer);
  void note_foreign(const std::string& topic);
  void note_stranger() noexcept { ++foreign_samples_; }
  void note_refused(const std::string& topic, std::uint64_t writer, std::string why);
  void collect_matches(Endpoint& endpoint);
  void collect_incompatible(const Endpoint& endpoint);

  BusConfig config_;
  std::uint64_t writer_;
  std::uint32_t number_;             ///< Of the domain within this process.
  std::unique_ptr<CycloneLog> log_;  ///< None if another bus of this process has it.
  dds_entity_t domain_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t publisher_ = 0;
  dds_entity_t subscriber_ = 0;
  std::unique_ptr<Participants> participants_;
  std::unique_ptr<ShortSocket> short_way_;  ///< To send from; null: all goes by DDS.
  std::vector<Endpoint> endpoints_;
  std::vector<BusEvent> events_;
  std::uint64_t foreign_samples_ = 0;
  std::uint64_t foreign_told_ = 0;  ///< Of these, those that are no strangers of the short way.
  std::uint64_t refused_samples_ = 0;
};

}  // namespace rave::bus
