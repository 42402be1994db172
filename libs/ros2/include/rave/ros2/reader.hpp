// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "rave/bus/endpoint.hpp"
#include "rave/ros2/end.hpp"
#include "rave/ros2/messages.hpp"
#include "rave/ros2/validate.hpp"

namespace rave::ros2 {

/// Reads one topic of ROS 2. Destroy it before its participant. One thread at a time.
template <class Message>
class Reader {
 public:
  /// The limit per call, so that a sender that never stops cannot occupy the receiver's thread.
  static constexpr std::size_t kMostAtOnce = 1024;

  /// `topic` is an absolute name: `/cart/scan`. Errors: those of Participant::add_end().
  [[nodiscard]] static Result<Reader> create(const Participant& participant, std::string_view topic,
                                             const bus::QosProfile& profile) {
    RAVE_TRY_ASSIGN(End end,
                    End::create(participant, descriptor_of<Message>(), topic, profile, true));
    return Reader(std::move(end));
  }

  /// Calls `visit(const Message&)`, or `visit(const Message&, dds_instance_handle_t writer)`, for
  /// every received sample, oldest first. Samples are loans: valid during the call only. Samples
  /// that validate() refuses are dropped and counted. Returns the number of visited samples. The
  /// callback must not throw.
  template <class Visit>
  std::size_t take(Visit&& visit) {
    std::size_t visited = 0;
    bus::Loan loan;
    for (std::size_t taken = 0; taken < kMostAtOnce; taken += bus::Loan::kBatch) {
      bus::take(handle(), loan);
      for (std::size_t i = 0; i < loan.size; ++i) {
        // The end of a writer arrives as a sample without values.
        if (!loan.infos[i].valid_data) continue;
        const auto& sample = *static_cast<const Message*>(loan.samples[i]);
        Status status = validate(sample);
        if (!status) {
          refuse(std::move(status).error());
          continue;
        }
        if constexpr (std::is_invocable_v<Visit, const Message&, dds_instance_handle_t>) {
          visit(sample, loan.infos[i].publication_handle);
        } else {
          visit(sample);
        }
        ++visited;
      }
      const bool more = loan.size == bus::Loan::kBatch;
      bus::give_back(handle(), loan);
      if (!more) break;
    }
    return visited;
  }

  /// Refuses a sample for a reason that only the caller can know.
  void refuse(Error why) {
    ++refused_;
    trouble_ = std::move(why.message);
  }
  /// The number of refused samples, and the reason of the last one.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  /// For questions about its writers.
  [[nodiscard]] const End& end() const noexcept { return end_; }
  /// See bus::take_mismatch().
  [[nodiscard]] std::optional<std::string> take_mismatch() { return end_.take_mismatch(); }
  /// See Participant::explain_silence().
  [[nodiscard]] std::string explain_silence() const { return end_.explain_silence(); }
  [[nodiscard]] const std::string& topic() const noexcept { return end_.topic(); }
  /// The DDS reader, for a Waiter. Still owned by this object.
  [[nodiscard]] dds_entity_t handle() const noexcept { return end_.handle(); }

 private:
  explicit Reader(End end) : end_(std::move(end)) {}

  End end_;
  std::uint64_t refused_ = 0;
  std::string trouble_;
};

}  // namespace rave::ros2
