// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

/// The last 20 s before a moment, sent to a page piece by piece: poses for its trails, readings for
/// its plots over time. One thread.
class PastStream {
 public:
  using Send = std::function<void(std::string frame)>;
  struct Wanted {
    bool poses = false;
    std::vector<LookedAt> readings;  ///< Only of a recording: a run in progress keeps none.
    bool parts = false;              ///< Also of the halves of hybrid sensors.
  };
  /// `cursor` is its own: going back with that of the present would read a recording twice per
  /// tick.
  PastStream(std::unique_ptr<Cursor> cursor, double now_s, Wanted wanted);

  /// Sends until `bytes` are exceeded or `time` has passed. Frames of poses are numbered by
  /// `sequence`. False: all has been sent.
  bool send(std::size_t bytes, std::chrono::nanoseconds time, std::uint32_t& sequence,
            const Send& send);
  [[nodiscard]] bool has_poses() const noexcept { return wanted_.poses; }

 private:
  std::size_t send_poses(double t_s, std::uint32_t& sequence, const Send& send) const;
  std::size_t send_readings(const Send& send);

  std::unique_ptr<Cursor> cursor_;
  double next_s_;
  double until_s_;
  Wanted wanted_;
  /// Stamps of the readings that were sent last, by sensor and part.
  std::map<std::pair<LookedAt, std::uint8_t>, double> told_{};
};

}  // namespace rave::gui_server
