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
class LocalReceiver;
class LocalSender;
class LocalSocket;
class Standstill;
struct LifeSignEnds;

/// Another participant of the domain, with the properties that it announced. A value.
struct BusProcess {
  std::string name;
  RunId run;                 ///< None if it belongs to no run or is not a process of RAVE.
  std::uint64_t writer = 0;  ///< Its writer id; 0 if it has no run.
};

/// This process on the bus: one participant in one run. Its writers and readers must be destroyed
/// before it. A process has at most one bus per domain, except for those with BusConfig::beside.
///
/// Thread: one owner, which also uses its writers, readers and wait sets; only a stop token may be
/// used from another. The threads of Cyclone DDS call no code of RAVE.
class Bus {
 public:
  /// Joins the domain. Errors: kInvalidArgument (the configuration), kState (this process already
  /// has a bus in that domain), kIo (no such interface, no free port, invalid certificates).
  [[nodiscard]] static Result<std::unique_ptr<Bus>> open(const BusConfig& config);
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;
  ~Bus();

  [[nodiscard]] const BusConfig& config() const noexcept { return config_; }
  /// A random id of this execution of this process; all of its samples carry it as `writer`.
  [[nodiscard]] std::uint64_t writer() const noexcept { return writer_; }

  /// The events since the last call, oldest first. Call it regularly: at most kMaxEvents are kept.
  /// Beyond that, refused and foreign samples are only counted.
  [[nodiscard]] std::vector<BusEvent> take_events();

  /// The other processes in the domain, of this and of other runs, as of the last take_events().
  [[nodiscard]] std::vector<BusProcess> processes() const;

  /// When this process was last unable to run, up to this call. Silence of others during that time
  /// does not mean that they are lost. To judge silence, compare with a time from before this call.
  [[nodiscard]] const Standstill& standstill() const noexcept;

  /// The number of ignored samples: those of other runs, and datagrams of unknown senders on the
  /// local transport.
  [[nodiscard]] std::uint64_t foreign_samples() const noexcept { return foreign_samples_; }
  /// The number of samples that validate() refused.
  [[nodiscard]] std::uint64_t refused_samples() const noexcept { return refused_samples_; }

  static constexpr std::size_t kMaxEvents = 1000;
  /// How long writers that end wait for readers that are alive, but do not confirm their samples.
  /// All writers of a bus share it, as a process closes some twenty of them, one after another.
  static constexpr Duration kLastWords{1'000'000'000};

 private:
  friend class EndpointOwner;
  friend class WriterCore;
  friend class ReaderCore;
  friend class WaitSet;

  /// A writer or reader of this process and the entities that match it.
  struct Endpoint {
    dds_entity_t entity = 0;
    bool reads = false;
    std::string topic;
    struct Peer {
      dds_instance_handle_t handle = 0;
      dds_guid_t participant{};
    };
    std::vector<Peer> peers;
    std::vector<Peer> heard;  ///< Readers only: the writers whose samples have been received.
    bool recalls = false;     ///< Readers only; see QosProfile::recalls.
    /// The participants whose samples are to be handed out again.
    std::vector<dds_guid_t> returned;
    std::unique_ptr<LocalSender> sender;
    std::unique_ptr<LocalReceiver> receiver;
  };

  explicit Bus(BusConfig config);
  [[nodiscard]] Status open_domain();
  [[nodiscard]] Status open_hub();
  [[nodiscard]] Status open_participant();
  /// Opens the ends of the signs of life. The writer also announces this process: with security on,
  /// such announcements are encrypted, and those of participants are not.
  [[nodiscard]] Result<LifeSignEnds> open_life_sign();
  [[nodiscard]] tl::unexpected<Error> refused(dds_return_t code);
  [[nodiscard]] Result<dds_entity_t> make_topic(const TopicSpec& spec);
  /// Creates a reader or writer of a topic.
  [[nodiscard]] Result<dds_entity_t> add_endpoint(const TopicSpec& topic, bool reads);
  /// A writer first waits until its last samples have arrived.
  void remove_endpoint(dds_entity_t entity);
  /// Waits until all readers of a writer that are alive have its samples, at most for `patience`.
  /// DDS knows a silent process for much longer than that process counts as present, so it alone
  /// would wait for the dead.
  [[nodiscard]] Status await_arrival(dds_entity_t writer, Duration patience);
  /// The record of an entity, valid until the next one is created; null if there is none.
  [[nodiscard]] Endpoint* endpoint(dds_entity_t entity);
  void open_local_transport(Endpoint& endpoint, const TopicSpec& topic);
  /// Tells the local transport of an endpoint which entities match it. Takes no events.
  void meet(Endpoint& endpoint);
  /// Whether DDS writer `from`, the source of a sample of `reader`, belongs to the process with id
  /// `writer`. True if that is not known.
  [[nodiscard]] bool speaks_for(dds_entity_t reader, dds_instance_handle_t from,
                                std::uint64_t writer);
  void note_foreign(const std::string& topic);
  void note_stranger() noexcept { ++foreign_samples_; }
  void note_refused(const std::string& topic, std::uint64_t writer, std::string why);
  /// `all`: also those that DDS has not told of, since a process fell silent or came back.
  void collect_matches(Endpoint& endpoint, bool all);
  void collect_incompatible(const Endpoint& endpoint);

  BusConfig config_;
  std::uint64_t writer_;
  std::uint32_t number_;             ///< The number of the domain within this process.
  std::unique_ptr<CycloneLog> log_;  ///< Null if another bus of this process owns the sink.
  dds_entity_t domain_ = 0;
  dds_entity_t participant_ = 0;
  dds_entity_t publisher_ = 0;
  dds_entity_t subscriber_ = 0;
  std::unique_ptr<Participants> participants_;
  std::unique_ptr<LocalSocket>
      local_transport_;  ///< The socket to send from; null: all samples use DDS.
  std::vector<Endpoint> endpoints_;
  std::vector<BusEvent> events_;
  Duration last_words_ = kLastWords;  ///< What is left of it: time waited in vain is used up.
  std::uint64_t silences_ = 0;  ///< Participants::silences() that the matches already reflect.
  std::uint64_t foreign_samples_ = 0;
  /// The foreign samples already reported, without those of the local transport.
  std::uint64_t foreign_told_ = 0;
  std::uint64_t refused_samples_ = 0;
};

/// Opens several writers and readers, up to the first that fails.
template <class... Ends>
[[nodiscard]] Status open_all(Bus& bus, Ends&... ends) {
  Status status;
  static_cast<void>(((status = ends.open(bus)).has_value() && ...));
  return status;
}

}  // namespace rave::bus
