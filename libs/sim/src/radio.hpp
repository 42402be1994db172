// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "arrivals.hpp"
#include "radio_parts.hpp"
#include "rave/sim/engine.hpp"
#include "rave/sim/sent_packet.hpp"
#include "rave/sim/thread_pool.hpp"
#include "robot_group.hpp"

namespace rave::sim {

/// What the radio needs to know of a step.
struct RadioMoment {
  std::uint64_t step = 0;
  SimTime now;
  std::span<const ReportedPose> reported;
  const world::Snapshot* snapshot = nullptr;
  RunHash* hash = nullptr;
  std::vector<Event>* events = nullptr;
};

/// All communicators and transmitters of a run: takes messages out of outboxes, sends them as fast
/// as rates allow, finds out who hears them, and puts them into inboxes. Belongs to the engine's
/// thread; uses the pool inside carry(). The result does not depend on the number of threads.
class Radio {
 public:
  /// Keeps references to all, which outlive it. `local`: by robot, 1 if it runs here. Of others it
  /// is known that they have communicators, no more; what they send comes through receive().
  Radio(const EngineSpec& spec, const std::vector<std::uint8_t>& local, std::vector<RobotLog>& logs,
        ThreadPool& pool)
      : spec_(spec), local_(local), logs_(logs), pool_(pool), live_(spec.own_authority) {}
  Radio(const Radio&) = delete;
  Radio& operator=(const Radio&) = delete;
  /// Devices must be closed.
  ~Radio() = default;

  /// Starts the message models and lays out mailboxes. Errors name robot and communicator.
  Status make();
  /// Configures the transmitters, once; opens those that are devices.
  Status open();
  /// The devices that are open, for who closes them; they count as closed from now on.
  [[nodiscard]] std::vector<ToClose> take_open();
  /// Back to silence; devices must be closed.
  void clear();

  [[nodiscard]] const CommunicatorView* views_of(RobotId robot) const noexcept {
    return views_.data() + first_endpoint_[robot.value()];
  }
  [[nodiscard]] std::span<const CommunicatorInfo> infos_of(std::uint32_t type) const noexcept {
    return infos_[type];
  }

  /// Before decide: puts what arrives in this step into inboxes.
  void deliver(const RadioMoment& moment);
  /// After the program of a robot has decided, or would have if it had one: `accepted` says whether
  /// what it sent counts. Robots in the order of their ids.
  void collect(const RadioMoment& moment, RobotId robot, bool accepted);
  /// After all have been collected: sends what can be sent in this step.
  void carry(const RadioMoment& moment);
  /// The two halves of carry() for one of several hosts: `sent` is filled with what leaves robots
  /// that run here, and later receive() finds out who of them hears what left all robots. The
  /// moment of both is that of the sending. Errors of receive(): kPlugin (a model failed, which
  /// other hosts cannot know).
  void send(const RadioMoment& moment, SentPackets& sent);
  Status receive(const RadioMoment& moment, const SentPackets& sent);

  [[nodiscard]] bool empty() const noexcept { return endpoints_.empty(); }
  [[nodiscard]] const RadioCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::span<const RadioTrace> traces() const noexcept { return traces_; }
  [[nodiscard]] std::string report(RobotId robot, std::uint32_t transmitter) const;

 private:
  /// What one block of packets found out.
  struct Reach {
    std::vector<Delivery> deliveries;
    std::vector<std::uint64_t> arrivals;  ///< Step of each delivery.
    std::vector<std::uint32_t> candidates;
    RadioCounts counts;
    std::uint32_t failed_model = kNobody;
    std::string failure;
  };

  // radio_make.cpp
  Status make_models();
  Status make_robot(std::uint32_t robot);
  void lay_out_mailboxes();
  void name_channels();
  Status configure_line(RadioLine& line);
  Status check_packet_sizes(const RadioLine& line) const;
  Status open_line(RadioLine& line);
  [[nodiscard]] std::uint32_t team_of(std::uint32_t robot);

  // radio.cpp
  void hand_over(const RadioMoment& moment, Endpoint& to, MessageHead head, std::uint32_t packet);
  void trace(const MessageHead& head, const Endpoint& at, bool delivered, std::int64_t complete_ns,
             std::uint32_t packet);
  void show_payloads();
  void offer(const RadioMoment& moment, Endpoint& sender, const MessageHead& message);
  void send_out(const RadioMoment& moment);
  [[nodiscard]] PacketOrigin origin_of(const RadioMoment& moment, const Endpoint& sender) const;
  void write_sent(SentPackets& sent);
  void find_receivers(const RadioMoment& moment);
  void count_failure(const RadioMoment& moment, const Reach& reach);

  // radio_reach.cpp: who hears what is carried in this process
  void place(Channel& channel, const RadioMoment& moment);
  void find_candidates(const StoredPacket& sent, Reach& reach) const;
  void reach(std::uint32_t packet, const RadioMoment& moment, Reach& reach) const;
  void reach_one(std::uint32_t packet, const Endpoint& to, std::uint32_t to_index,
                 const RadioMoment& moment, Reach& reach) const;

  /// What becomes of a packet, of which `query` says size, sender and number, on its way to an
  /// endpoint; nothing if it does not arrive, which is counted in `reach`.
  [[nodiscard]] std::optional<LinkAnswer> link(const PacketOrigin& sender, BodyId sender_body,
                                               const Endpoint& to, LinkQuery query,
                                               const RadioMoment& moment, Reach& reach) const;

  /// What the model of a receiver says; one that fails lets nothing arrive and is noted in `reach`.
  [[nodiscard]] LinkAnswer ask(std::uint32_t model, const LinkQuery& query, Reach& reach) const;

  // radio_device.cpp: packets that devices carry
  void hear(const RadioMoment& moment);
  void hear_packet(const RadioMoment& moment, RadioLine& line, const RadioPacket& packet);
  [[nodiscard]] bool in_reach(const RadioMoment& moment, const Endpoint& to,
                              const RadioPacket& packet, std::uint32_t from);
  void note_flood(RadioLine& line);
  [[nodiscard]] std::uint32_t sending_device(std::uint32_t from, const RadioPacket& packet) const;
  void note_device(const RadioMoment& moment, RadioLine& line);
  void transmit(const RadioMoment& moment, RadioLine& line, std::uint32_t packet);
  [[nodiscard]] std::uint32_t robot_of_hash(std::uint32_t hash);

  const EngineSpec& spec_;
  const std::vector<std::uint8_t>& local_;
  std::vector<RobotLog>& logs_;
  ThreadPool& pool_;
  ThreadPool::Effort effort_;
  bool live_;  ///< Messages come from other processes, and not in lock-step.
  std::vector<RadioModel> models_;
  std::vector<std::vector<std::uint32_t>> models_of_;  ///< By type and communicator.
  std::vector<std::vector<CommunicatorInfo>> infos_;   ///< By type.
  std::vector<Endpoint> endpoints_;
  std::vector<std::uint32_t> first_endpoint_;  ///< By robot; one more at the end.
  std::vector<RadioLine> lines_;
  std::vector<std::uint32_t> first_line_;  ///< By robot; one more at the end.
  std::vector<Channel> channels_;
  std::vector<std::string> teams_;
  std::vector<CommunicatorView> views_;  ///< By endpoint.
  std::vector<MessageHead> mailbox_heads_;
  std::vector<std::byte> mailbox_bytes_;
  std::uint32_t longest_message_ = 0;
  bool configured_ = false;

  PacketStore packets_;
  Arrivals arrivals_;
  std::vector<std::uint32_t> done_;      ///< Packets to be let go of when the next step begins.
  std::vector<std::uint32_t> complete_;  ///< Sent in this step.
  std::vector<std::uint32_t> carried_;   ///< ... in this process.
  std::vector<Reach> reaches_;
  std::vector<world::ShapePiece> items_;
  std::vector<std::byte> encoded_;
  std::vector<std::uint32_t> name_hash_;            ///< By robot.
  std::map<std::uint32_t, std::uint32_t> by_hash_;  ///< Names heard of: RobotId.
  std::vector<std::uint32_t> foreign_;              ///< Hashes of senders beyond the robots.
  RadioCounts counts_;
  std::vector<RadioTrace> traces_;
  std::vector<std::uint32_t> trace_packets_;
};

}  // namespace rave::sim
