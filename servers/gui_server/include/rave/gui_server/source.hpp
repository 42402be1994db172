// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/base/result.hpp"

// What the GUI Server shows comes from a source: today a recording, next a run. Plain values; SI
// units, frame W, angles in radians, times in seconds of the run.
namespace rave::gui_server {

/// What the run is called and where it comes from.
struct RunAbout {
  std::string name;
  std::string started;  ///< ISO 8601; empty if unknown.
  double step_s = 0;
  std::uint64_t seed = 0;
  std::string hash;  ///< 16 hexadecimal digits; empty: none.
  bool lock_step = true;
  std::filesystem::path recording;  ///< Empty: none.
  std::uint64_t recording_bytes = 0;
  bool recording_whole = false;
  double begin_s = 0;
  double end_s = 0;
  double duration_s = 0;
};

/// Bits of RobotState::flags, as they go into a pose frame.
enum RobotFlag : std::uint16_t {
  kKnown = 1,
  kStale = 2,
  kStopped = 4,
  kUnarmed = 8,
  kReal = 16,
  kTouching = 32,
  kPoseLost = 64,
};

struct RobotState {
  double x_m = 0;
  double y_m = 0;
  double yaw_rad = 0;
  double speed_mps = 0;  ///< Over ground, forward positive.
  std::uint16_t flags = 0;
};

/// Where all robots are at one moment; by index of the roster.
struct PosesAt {
  double time_s = 0;
  std::uint64_t step = 0;
  std::vector<RobotState> robots;
};

/// One reading as rows of numbers.
struct ReadingAt {
  std::uint32_t slot = 0;
  std::uint32_t sensor = 0;
  std::uint8_t part = 0;  ///< 0 what the program got, 1 real half, 2 virtual half.
  double stamp_s = 0;
  std::uint32_t rows = 0;
  std::uint32_t fields = 0;
  std::vector<float> values;
};

/// A sensor that somebody looks at.
struct LookedAt {
  std::uint32_t slot = 0;
  std::uint32_t sensor = 0;
  friend auto operator<=>(const LookedAt&, const LookedAt&) = default;
};

/// Something that happened, as the log shows it; repetitions folded.
struct LogEvent {
  double t_s = 0;
  double until_s = 0;
  std::uint32_t count = 1;
  std::string kind;
  enum class Level : std::uint8_t { kInfo, kWarn, kAlert } level = Level::kInfo;
  std::string text;
  std::vector<std::uint32_t> slots;
};

/// One viewer's place in time. One thread.
class Cursor {
 public:
  virtual ~Cursor() = default;
  /// Goes to the newest state at or before `time_s`, forwards or backwards. Errors: kIo, kParse
  /// (a damaged piece; going elsewhere may work).
  [[nodiscard]] virtual Status go_to(double time_s) = 0;
  [[nodiscard]] virtual const PosesAt& poses() const noexcept = 0;
  /// The newest readings of `sensors` at this moment.
  [[nodiscard]] virtual std::vector<ReadingAt> readings(std::span<const LookedAt> sensors,
                                                        bool parts) = 0;
};

/// One thread, which is that of the server.
class Source {
 public:
  virtual ~Source() = default;
  [[nodiscard]] virtual const RunAbout& about() const noexcept = 0;
  /// The arrays `bodies` of a message `scene` and `robots` of a message `roster`, as JSON.
  [[nodiscard]] virtual const std::string& bodies_json() const noexcept = 0;
  [[nodiscard]] virtual const std::string& robots_json() const noexcept = 0;
  [[nodiscard]] virtual std::uint32_t robot_count() const noexcept = 0;
  [[nodiscard]] virtual std::span<const LogEvent> events() const noexcept = 0;
  [[nodiscard]] virtual std::unique_ptr<Cursor> open_cursor() = 0;
};

/// Plays the record of a run. Errors: those of record::open_run() and McapReader::open(), kParse
/// (not written by RAVE), and those of the scenario in it (a map that is missing).
[[nodiscard]] Result<std::shared_ptr<Source>> open_recording(const std::filesystem::path& file);

}  // namespace rave::gui_server
