// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "foxglove/foxglove_wire.hpp"
#include "rave/gui_server/source.hpp"

namespace rave::gui_server {

/// The most sensors that have a topic.
inline constexpr std::size_t kMostScans = 500;

/// What a Foxglove client can subscribe to of one source, and the messages of it in JSON. A source
/// that leaves out what a user may not see has neither topics nor messages of it. Immutable; any
/// thread.
class FoxgloveTopics {
 public:
  enum class Kind : std::uint8_t {
    kTransforms,  ///< `/tf`: where robots are.
    kScene,       ///< `/scene`: bodies that stand.
    kRobots,      ///< `/robots`: what robots look like, in their frames.
    kPoses,       ///< `/poses`: numbers for plots.
    kLog,         ///< `/log`
    kRun,         ///< `/run`: clock, pace and speed.
    kScan,        ///< `/scan/ROBOT/SENSOR`
  };
  struct Topic {
    FoxgloveChannel channel;
    Kind kind = Kind::kTransforms;
    LookedAt sensor;  ///< Of kScan.
  };

  /// Channels get numbers from `first_channel` on.
  FoxgloveTopics(const Source& source, std::uint32_t first_channel);

  [[nodiscard]] const std::vector<Topic>& topics() const noexcept { return topics_; }
  [[nodiscard]] std::vector<FoxgloveChannel> channels() const;
  /// Null: there is none.
  [[nodiscard]] const Topic* topic_of(std::uint32_t channel) const;
  /// Range sensors that have no topic, since there are more than kMostScans.
  [[nodiscard]] std::size_t left_out() const noexcept { return left_out_; }
  /// Entries of the array `robots` of the source, by slot.
  [[nodiscard]] const std::vector<nlohmann::ordered_json>& robots() const noexcept {
    return robots_;
  }

  /// Robots without a pose have no transform.
  [[nodiscard]] std::string transforms(const PosesAt& poses) const;
  [[nodiscard]] std::string poses(const PosesAt& poses) const;
  /// Rays that hit nothing are left out. Empty: it is of a sensor without a topic.
  [[nodiscard]] std::string points(const ReadingAt& reading) const;
  [[nodiscard]] static std::string log(const LogEvent& event);
  [[nodiscard]] static std::string run(const PlayState& state);

 private:
  struct Scanner {
    LookedAt sensor;
    std::array<double, 3> X_RS{};  ///< x, y, yaw.
    double z_m = 0;
    std::vector<double> bearings_rad;
  };
  void add(Kind kind, const std::string& topic, const char* schema);
  void add_scans(std::uint32_t slot);

  std::uint32_t next_;
  std::vector<Topic> topics_;
  std::vector<Scanner> scanners_;  ///< Ascending by sensor.
  std::size_t left_out_ = 0;
  std::vector<nlohmann::ordered_json> robots_;
  std::vector<std::string> names_;   ///< Quoted for JSON, by slot.
  std::vector<std::string> frames_;  ///< The same.
};

}  // namespace rave::gui_server
