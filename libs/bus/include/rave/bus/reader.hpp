// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "rave/bus/bus.hpp"
#include "rave/bus/endpoint.hpp"
#include "rave/bus/endpoint_owner.hpp"
#include "rave/bus/validate.hpp"

namespace rave::bus {

/// The part of Reader that does not depend on the message type. Owner: a Reader.
class ReaderCore : public EndpointOwner {
 public:
  /// The limit per call, so that a sender that never stops cannot occupy the receiver's thread.
  static constexpr std::size_t kMostAtOnce = 4096;

  [[nodiscard]] static Result<ReaderCore> create(Bus& bus, const TopicSpec& topic);

  /// Begins a take. Returns how many datagrams it may read; 0: all samples come through DDS.
  [[nodiscard]] std::size_t begin_take();
  /// The next sample of the local transport, valid until the next call; null if there is none.
  /// `budget` is the number of datagrams that may still be read; must be above 0; decreased.
  [[nodiscard]] const void* take_local(std::size_t& budget);
  /// Whether a take that has (`got`) received a sample by the local transport may skip DDS this
  /// time.
  [[nodiscard]] bool leaves_dds(bool got);
  /// Called with a sample and what DDS knows of it.
  using Visit = std::function<void(const void*, const dds_sample_info_t&)>;
  /// Begins to take what came through DDS: hands out again what processes have said that are back,
  /// and forgets what those said that have left. Only of topics with QosProfile::recalls.
  void recall(const Visit& visit);
  /// The next samples that came through DDS. Give them back before the next call.
  void next(Loan& loan);
  void note_foreign() { bus().note_foreign(topic_); }
  /// Whether the sample comes from the process whose id it carries; if not, it is refused.
  [[nodiscard]] bool is_of(std::uint64_t writer, const dds_sample_info_t& info);
  void refuse(std::uint64_t writer, std::string why);
  [[nodiscard]] std::size_t writers() const;

 private:
  /// Visits what has been read before and is still there.
  void read_all_again(const Visit& visit) const;

  LocalReceiver* local_ = nullptr;  ///< Owned by the bus; null: all samples come through DDS.
  /// Whether a sample has come that was not read. Only of topics with QosProfile::recalls.
  [[nodiscard]] bool has_news() const { return dds_triggered(news_) > 0; }

  dds_entity_t news_ = 0;  ///< The condition that has_news() asks.
  /// The type of the samples of a topic with QosProfile::recalls; null: of another.
  const dds_topic_descriptor_t* recalled_ = nullptr;
  std::uint64_t sender_ = 0;  ///< The sender of the last sample of the local transport.
};

/// Reads one topic. Destroy it before its bus; thread: that of the bus.
template <class Message>
class Reader {
 public:
  /// Not open: only open() may be called.
  Reader() = default;
  /// Creates a reader. Errors: kState (the topic exists with another type), kIo.
  [[nodiscard]] static Result<Reader> create(Bus& bus) {
    Reader reader;
    RAVE_TRY(reader.open(bus));
    return reader;
  }
  /// The same for a member; see open_all().
  [[nodiscard]] Status open(Bus& bus) {
    RAVE_TRY_ASSIGN(core_, ReaderCore::create(bus, topic_of<Message>()));
    return {};
  }
  /// The same with QoS other than the topic's, for monitors: they must not request more than
  /// writers offer anyway.
  [[nodiscard]] Status open(Bus& bus, const QosProfile& qos) {
    TopicSpec topic = topic_of<Message>();
    topic.qos = qos;
    topic.local_transport = 0;
    RAVE_TRY_ASSIGN(core_, ReaderCore::create(bus, topic));
    return {};
  }

  /// Calls `visit(const Message&)`, or `visit(const Message&, const dds_sample_info_t&)`, for every
  /// received sample, oldest first per instance. Calls `gone(const Message&)` for every object that
  /// its writer disposed of; only the key fields are valid then. Samples are loans: not copied,
  /// valid during the call only. Samples of other runs, those with the writer id of another
  /// process, and those that validate() refuses are dropped, counted, and reported as events.
  /// Callbacks must not throw and must not take from this reader.
  ///
  /// Returns the number of visited samples. After kMostAtOnce the rest stays for the next call.
  /// Samples of the local transport come first; if one of them ended the preceding wait, samples of
  /// DDS may be left for the next call, and end the next wait.
  template <class Visit, class Gone>
  std::size_t take(Visit&& visit, Gone&& gone) {
    std::size_t visited = take_local(visit, gone);
    if (core_.leaves_dds(visited > 0)) return visited;
    core_.recall([&](const void* sample, const dds_sample_info_t& info) {
      visited += hand_over(*static_cast<const Message*>(sample), info, visit, gone);
    });
    Loan loan;
    for (std::size_t taken = 0; taken < ReaderCore::kMostAtOnce; taken += Loan::kBatch) {
      core_.next(loan);
      for (std::size_t i = 0; i < loan.size; ++i) {
        const auto& sample = *static_cast<const Message*>(loan.samples[i]);
        visited += hand_over(sample, loan.infos[i], visit, gone);
      }
      const bool more = loan.size == Loan::kBatch;
      give_back(handle(), loan);
      if (!more) break;
    }
    return visited;
  }
  template <class Visit>
  std::size_t take(Visit&& visit) {
    return take(std::forward<Visit>(visit), [](const Message&) {});
  }

  /// Refuses a sample for a reason that only the caller can know. It is counted and reported like
  /// the others.
  void refuse(const Message& sample, std::string_view why) {
    core_.refuse(sample.writer, std::string(why));
  }

  /// The number of matched writers.
  [[nodiscard]] std::size_t writers() const { return core_.writers(); }
  /// The DDS reader, for what this class does not offer. Still owned by this object.
  [[nodiscard]] dds_entity_t handle() const noexcept { return core_.handle(); }

 private:
  template <class Visit>
  static constexpr bool kAsksInfo =
      std::is_invocable_v<Visit&, const Message&, const dds_sample_info_t&>;

  template <class Visit, class Gone>
  std::size_t take_local(Visit& visit, Gone& gone) {
    std::size_t visited = 0;
    std::size_t budget = core_.begin_take();
    while (budget > 0) {
      const void* const sample = core_.take_local(budget);
      if (sample == nullptr) break;
      dds_sample_info_t info{};
      info.valid_data = true;
      info.sample_state = DDS_SST_NOT_READ;
      info.instance_state = DDS_IST_ALIVE;
      if constexpr (kAsksInfo<Visit>) info.source_timestamp = dds_time();
      visited += hand_over(*static_cast<const Message*>(sample), info, visit, gone);
    }
    return visited;
  }

  template <class Visit, class Gone>
  std::size_t hand_over(const Message& sample, const dds_sample_info_t& info, Visit& visit,
                        Gone& gone) {
    const bool disposed = info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE;
    if (!info.valid_data && !disposed) return 0;
    const BusConfig& config = core_.bus().config();
    if (!config.all_runs && !config.run.equals(sample.run)) {
      core_.note_foreign();
      return 0;
    }
    if (!core_.is_of(sample.writer, info)) return 0;
    const bool good = info.valid_data && judge(sample);
    if constexpr (kAsksInfo<Visit>) {
      if (good) visit(sample, info);
    } else {
      if (good) visit(sample);
    }
    // DDS repeats the disposal with every sample of the object; report it with the last one only.
    if (disposed && info.sample_rank == 0) gone(sample);
    return good ? 1 : 0;
  }

  bool judge(const Message& sample) {
    Status status = validate(sample);
    if (!status) core_.refuse(sample.writer, std::move(status.error().message));
    return status.has_value();
  }

  ReaderCore core_;
};

}  // namespace rave::bus
