// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "rave/bus/endpoint.hpp"
#include "rave/ros2/end.hpp"
#include "rave/ros2/messages.hpp"
#include "rave/ros2/validate.hpp"

namespace rave::ros2 {

/// Reads one topic of ROS 2. Must be gone before its participant. One thread at a time.
template <class Message>
class Reader {
 public:
  /// A sender that never stops must not keep the receiver from everything else.
  static constexpr std::size_t kMostAtOnce = 1024;

  /// `topic` is whole: `/cart/scan`. Errors: those of Participant::add_end().
  [[nodiscard]] static Result<Reader> create(const Participant& participant, std::string_view topic,
                                             const bus::QosProfile& profile) {
    RAVE_TRY_ASSIGN(End end,
                    End::create(participant, descriptor_of<Message>(), topic, profile, true));
    return Reader(std::move(end));
  }

  /// Calls `visit(const Message&)` for every sample that has come, oldest first. Samples are on
  /// loan: valid during the call only. Those that validate() refuses are dropped and counted.
  /// Returns how many were visited. The callback must not throw.
  template <class Visit>
  std::size_t take(Visit&& visit) {
    std::size_t visited = 0;
    bus::Loan loan;
    for (std::size_t taken = 0; taken < kMostAtOnce; taken += bus::Loan::kBatch) {
      bus::take(handle(), loan);
      for (std::size_t i = 0; i < loan.size; ++i) {
        // A writer that ends says so by a sample without values.
        if (!loan.infos[i].valid_data) continue;
        const auto& sample = *static_cast<const Message*>(loan.samples[i]);
        Status status = validate(sample);
        if (!status) {
          refuse(std::move(status).error());
          continue;
        }
        visit(sample);
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
  /// How many samples were refused, and why the last of them was.
  [[nodiscard]] std::uint64_t refused() const noexcept { return refused_; }
  [[nodiscard]] const std::string& trouble() const noexcept { return trouble_; }
  /// How many writers are known now.
  [[nodiscard]] std::size_t writers() const { return end_.matched(); }
  /// As of bus::take_mismatch().
  [[nodiscard]] std::optional<std::string> take_mismatch() { return end_.take_mismatch(); }
  /// As of Participant::explain_silence().
  [[nodiscard]] std::string explain_silence() const { return end_.explain_silence(); }
  [[nodiscard]] const std::string& topic() const noexcept { return end_.topic(); }
  /// For a Waiter; the entity stays its own.
  [[nodiscard]] dds_entity_t handle() const noexcept { return end_.handle(); }

 private:
  explicit Reader(End end) : end_(std::move(end)) {}

  End end_;
  std::uint64_t refused_ = 0;
  std::string trouble_;
};

}  // namespace rave::ros2
