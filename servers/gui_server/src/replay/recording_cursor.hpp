// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <tuple>
#include <vector>

#include "rave/gui_server/source.hpp"
#include "rave/record/mcap_reader.hpp"
#include "replay/body_history.hpp"

namespace rave::gui_server {

/// When flags of robots change, by robot and in order of time.
struct FlagChange {
  double t_s = 0;
  RobotFlag flag = kKnown;
  bool on = false;
};
using FlagHistory = std::vector<std::vector<FlagChange>>;

/// A viewer's place in a recording. Forward it reads the file in order; going back, or far ahead,
/// begins anew near the moment.
class RecordingCursor final : public Cursor {
 public:
  /// What it reads belongs to a source that outlives it. `kinds`: whether each robot is real.
  /// `longest_period_s`: of any sensor; so far before a moment its readings may lie.
  RecordingCursor(const record::McapReader& reader, const FlagHistory& flags,
                  const std::vector<std::uint8_t>& real, const BodyHistory& bodies, double step_s,
                  double longest_period_s);

  [[nodiscard]] Status go_to(double time_s) override;
  [[nodiscard]] const PosesAt& poses() const noexcept override { return poses_; }
  [[nodiscard]] std::vector<ReadingAt> readings(std::span<const LookedAt> sensors,
                                                bool parts) override;
  [[nodiscard]] std::string take_bodies() override { return bodies_.change_to(time_s_); }

 private:
  using Bytes = std::vector<std::byte>;
  void begin_at(double time_s);
  [[nodiscard]] Status read_until(double time_s);
  /// What is known of variances before `until_ns`, beyond where the cursor begins.
  [[nodiscard]] Status find_variances(std::uint64_t until_ns);
  [[nodiscard]] Status show(const Bytes& poses);
  [[nodiscard]] Status show_variances();
  void set_flags();

  const record::McapReader& reader_;
  const FlagHistory& flags_;
  const std::vector<std::uint8_t>& real_;
  ToldBodies bodies_;
  double step_s_;
  double look_back_s_;
  std::uint16_t poses_channel_ = 0;
  std::optional<std::uint16_t> percepts_channel_;
  bool reads_percepts_ = false;  ///< From the first call of readings() on.
  std::optional<std::uint16_t> variances_channel_;
  std::optional<record::MessageCursor> cursor_;
  std::optional<std::tuple<std::uint64_t, std::uint16_t, Bytes>> ahead_;  ///< Read, and later.
  double time_s_ = -1;
  Bytes newest_;     ///< The last message of poses that was read.
  Bytes variances_;  ///< The last one of variances; empty: none are known.
  /// Messages of percepts within the longest period, oldest first.
  std::vector<std::pair<double, Bytes>> percepts_;
  PosesAt poses_;
};

}  // namespace rave::gui_server
