// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

/// The time of one page that plays a recording: it may hold it, seek, and change its pace.
class ReplayPlayhead final : public Playhead {
 public:
  /// `about` outlives it.
  ReplayPlayhead(const RunAbout& about, Clock::time_point now);

  std::string take(const TransportMessage& transport, Clock::time_point now) override;
  PlayState look(Clock::time_point now) override;

 private:
  [[nodiscard]] double due_s(Clock::time_point now) const;
  void go_to(double time_s, Clock::time_point now);

  const RunAbout& about_;
  bool running_ = true;
  double pace_ = 1;
  double at_s_;  ///< At `since_`.
  Clock::time_point since_;
  std::uint64_t picture_ = 1;
  bool jumped_ = true;
};

}  // namespace rave::gui_server
