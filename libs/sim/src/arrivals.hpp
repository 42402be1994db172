// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace rave::sim {

/// One message for one robot.
struct Delivery {
  std::uint64_t order = 0;   ///< Sender's endpoint and sequence number.
  std::uint32_t packet = 0;  ///< In the store.
  std::uint32_t to = 0;      ///< Endpoint.
};

/// Deliveries sorted by the step in which they arrive: a ring with one list for each step to come.
class Arrivals {
 public:
  /// The longest time that a message may take.
  static constexpr std::uint64_t kMaxSteps = 1U << 17U;

  void clear(std::uint64_t step) {
    step_ = step;
    for (auto& list : ring_) list.clear();
  }

  /// `arrival` lies after the step that was taken last, by at most kMaxSteps.
  void add(std::uint64_t arrival, const Delivery& delivery) {
    if (arrival - step_ >= ring_.size()) grow(arrival - step_ + 1);
    ring_[arrival % ring_.size()].push_back(delivery);
  }

  /// What arrives in `step`, in the order of (sender, sequence); valid until the next add().
  [[nodiscard]] std::vector<Delivery>& take(std::uint64_t step) {
    step_ = step;
    std::vector<Delivery>& due = ring_[step % ring_.size()];
    const auto earlier = [](const Delivery& a, const Delivery& b) {
      return a.order != b.order ? a.order < b.order : a.to < b.to;
    };
    if (!std::is_sorted(due.begin(), due.end(), earlier)) {
      std::sort(due.begin(), due.end(), earlier);
    }
    return due;
  }

 private:
  void grow(std::uint64_t steps) {
    std::size_t size = ring_.size();
    while (size < steps) size *= 2;
    std::vector<std::vector<Delivery>> ring(size);
    for (std::uint64_t k = 0; k < ring_.size(); ++k) {
      ring[(step_ + k) % size] = std::move(ring_[(step_ + k) % ring_.size()]);
    }
    ring_ = std::move(ring);
  }

  std::uint64_t step_ = 0;
  std::vector<std::vector<Delivery>> ring_ = std::vector<std::vector<Delivery>>(4);
};

}  // namespace rave::sim
