// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "rave/bus/bus.hpp"
#include "rave/bus/endpoint.hpp"
#include "rave/bus/validate.hpp"

namespace rave::bus {

/// What readers of all types share. Owner: a Reader.
class ReaderCore {
 public:
  /// A sender that never stops must not keep the receiver from everything else.
  static constexpr std::size_t kMostAtOnce = 4096;

  [[nodiscard]] static Result<ReaderCore> create(Bus& bus, const TopicSpec& topic);
  ReaderCore(ReaderCore&& other) noexcept;
  ReaderCore& operator=(ReaderCore&&) = delete;
  ~ReaderCore();

  void note_foreign() { bus_->note_foreign(topic_); }
  void refuse(std::uint64_t writer, std::string why);
  [[nodiscard]] std::size_t writers() const;
  [[nodiscard]] Bus& bus() const noexcept { return *bus_; }
  [[nodiscard]] dds_entity_t handle() const noexcept { return reader_; }

 private:
  ReaderCore(Bus& bus, const char* topic) : bus_(&bus), topic_(topic) {}

  Bus* bus_;
  const char* topic_;
  dds_entity_t reader_ = 0;
};

/// Reads one topic. Must be gone before its bus; thread: that of the bus.
template <class Message>
class Reader {
 public:
  /// Error: kState (the topic exists with another type), kIo.
  [[nodiscard]] static Result<Reader> create(Bus& bus) {
    return create(bus, topic_of<Message>().qos);
  }
  /// The same with other qualities of service than the topic has; for those who look on and must
  /// not ask writers for more than these give anyway.
  [[nodiscard]] static Result<Reader> create(Bus& bus, const QosProfile& qos) {
    TopicSpec topic = topic_of<Message>();
    topic.qos = qos;
    RAVE_TRY_ASSIGN(ReaderCore core, ReaderCore::create(bus, topic));
    return Reader(std::move(core));
  }

  /// Calls `visit(const Message&)`, or `visit(const Message&, const dds_sample_info_t&)` with the
  /// time of sending and the like, for every sample that has come, oldest first per instance, and
  /// `gone(const Message&)`, of which the key fields alone hold, for every object that its writer
  /// disposed of. Samples are on loan: valid during the call only, not copied. Those of other runs
  /// and those that validate() refuses are dropped, counted, and told as events. Returns how many
  /// were visited; after kMostAtOnce the rest waits for the next call. The callbacks must not throw
  /// and must not take from this reader.
  template <class Visit, class Gone>
  std::size_t take(Visit&& visit, Gone&& gone) {
    std::size_t visited = 0;
    Loan loan;
    for (std::size_t taken = 0; taken < ReaderCore::kMostAtOnce; taken += Loan::kBatch) {
      bus::take(handle(), loan);
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

  /// Refuses a sample for a reason that only the caller can know: counted and told like the others.
  void refuse(const Message& sample, std::string_view why) {
    core_.refuse(sample.writer, std::string(why));
  }

  /// How many writers are known now.
  [[nodiscard]] std::size_t writers() const { return core_.writers(); }
  /// For what this class does not do; the entity stays its own.
  [[nodiscard]] dds_entity_t handle() const noexcept { return core_.handle(); }

 private:
  explicit Reader(ReaderCore core) : core_(std::move(core)) {}

  template <class Visit, class Gone>
  std::size_t hand_over(const Message& sample, const dds_sample_info_t& info, Visit& visit,
                        Gone& gone) {
    const bool disposed = info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE;
    if (!info.valid_data && !disposed) return 0;
    if (!core_.bus().config().run.equals(sample.run)) {
      core_.note_foreign();
      return 0;
    }
    const bool good = info.valid_data && judge(sample);
    if constexpr (std::is_invocable_v<Visit&, const Message&, const dds_sample_info_t&>) {
      if (good) visit(sample, info);
    } else {
      if (good) visit(sample);
    }
    // Every sample of an object that is gone says so; the last of them counts.
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
