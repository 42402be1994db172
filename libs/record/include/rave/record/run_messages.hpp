// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rave/base/ids.hpp"
#include "rave/base/log.hpp"
#include "rave/base/result.hpp"
#include "rave/base/time.hpp"
#include "rave/math/pose.hpp"
#include "rave/record/run_info.hpp"

// The messages of a recording and their decoders. docs/reference/recording-format.md lists the
// topics. Decoding restores values bit by bit.
namespace rave::record {

/// Topics of the streams with exact values.
namespace topic {
inline constexpr const char* kRun = "/rave/run";
inline constexpr const char* kEnd = "/rave/end";
inline constexpr const char* kPoses = "/rave/poses";
inline constexpr const char* kPercepts = "/rave/percepts";
inline constexpr const char* kCommands = "/rave/commands";
inline constexpr const char* kActuators = "/rave/actuators";
inline constexpr const char* kRadio = "/rave/radio";
inline constexpr const char* kEvents = "/rave/events";
inline constexpr const char* kInputs = "/rave/inputs";
inline constexpr const char* kChat = "/rave/chat";
inline constexpr const char* kShadows = "/rave/shadows";
inline constexpr const char* kVariances = "/rave/variances";
inline constexpr const char* kHash = "/rave/hash";
inline constexpr const char* kConsole = "/rosout";
}  // namespace topic

/// The pose of a robot in one step, in W.
struct RobotPose {
  RobotId robot;
  std::optional<Pose2> true_pose;      ///< Simulated robots only.
  std::optional<Pose2> reported_pose;  ///< Empty until a real robot has reported one.
  Twist2 velocity_W;                   ///< Velocity of the origin over ground, in the axes of W.

  friend bool operator==(const RobotPose&, const RobotPose&) = default;
};

/// How sure a robot is of its reported pose. Both are 0 or above; of an older record none are
/// known.
struct PoseVariance {
  RobotId robot;
  double xy_m2 = 0;  ///< Of each of x and y.
  double yaw_rad2 = 0;

  friend bool operator==(const PoseVariance&, const PoseVariance&) = default;
};

/// As long as a robot has a variance, all variances are repeated after this time of the run.
inline constexpr std::int64_t kVariancesHold_ns = 1'000'000'000;

/// Which reading of a hybrid sensor: the result for the program, or one half before fusion.
enum class PerceptPart : std::uint8_t { kResult = 0, kReal = 1, kVirtual = 2 };

/// The fields of rave::SampleHeader.
struct ReadingHeader {
  std::int64_t stamp_ns = 0;
  std::uint32_t sequence = 0;
  std::uint32_t count = 0;
  std::uint32_t fresh = 0;
  std::uint32_t dropped = 0;

  friend bool operator==(const ReadingHeader&, const ReadingHeader&) = default;
};

/// One reading of one sensor. `records` are the bytes after the header, as the program received
/// them.
struct Percept {
  RobotId robot;
  DeviceId sensor;  ///< At most 65535.
  std::uint8_t kind = 0;
  PerceptPart part = PerceptPart::kResult;
  ReadingHeader header;
  std::span<const std::byte> records;
};

/// Readings of one sensor for consecutive robots `first`, `first` + 1, ... with equal headers and
/// equally many bytes of records each, concatenated.
struct PerceptBlock {
  RobotId first;
  std::uint32_t robots = 0;
  DeviceId sensor;  ///< At most 65535.
  std::uint8_t kind = 0;
  ReadingHeader header;
  std::span<const std::byte> records;  ///< A multiple of `robots` bytes.
};

/// Commands of consecutive robots to the same controller in one step.
struct CommandBlock {
  RobotId first;
  std::uint32_t robots = 0;
  DeviceId controller;
  std::span<const std::byte> commands;  ///< One rave::Command per robot, as bytes.
};

/// Poses of consecutive simulated robots whose reported pose is the true one. The pose of robot
/// `first` + i is i * `stride_bytes` behind `X_WR`, its velocity as far behind `velocity_W`.
struct PoseBlock {
  RobotId first;
  std::uint32_t robots = 0;
  const Pose2* X_WR = nullptr;
  const Twist2* velocity_W = nullptr;
  std::size_t stride_bytes = 0;
};

/// One command that a controller accepted: the bytes of a rave::Command.
struct CommandRecord {
  RobotId robot;
  DeviceId controller;
  std::span<const std::byte> command;
};

/// A command to an actuator, after the controllers: the bytes of a rave::Command. It holds until
/// the next one for the same actuator; only changes are recorded.
struct ActuatorRecord {
  RobotId robot;
  DeviceId actuator;
  std::span<const std::byte> command;
};

/// One packet between two robots.
struct RadioPacket {
  RobotId from;
  RobotId to;
  std::uint16_t transmitter = 0;
  bool delivered = true;
  std::int64_t sent_ns = 0;
  std::int64_t received_ns = 0;
  std::span<const std::byte> payload;
};

/// An event of a run: a contact, a stop by the guard, an edit of the world.
struct RunEvent {
  RobotId robot;     ///< None: it concerns the whole run.
  std::string kind;  ///< `contact`, `guard_stop`, `device_lost`, ...
  std::string text;
  std::vector<double> values;  ///< Their meaning depends on the kind.
};

/// A request that changed the run between two steps, complete enough to repeat it.
struct RunInput {
  std::uint64_t step = 0;  ///< The next step after the request.
  /// `stop`, `release`, `arm`, `set`, `hand_over`; of obstacles `edit`, in earlier recordings
  /// `add`, `move`, `remove`; orders of users `drive`, `goal`, `path`, `cancel`, `text`, `place`.
  std::string kind;
  std::string robot;  ///< Empty: all robots.
  std::string key;    ///< For `set`: the parameter, such as `program.max_speed_mps`.
  /// For `set` and `hand_over`: as in a file; for `edit`: the edit as JSON, with the keys of a
  /// scenario's `changes`; for orders: their content.
  std::string value;
  std::string by{};  ///< The user who sent it; empty: no named user, or an older recording.

  friend bool operator==(const RunInput&, const RunInput&) = default;
};

/// A chat message between users, optionally about robots. It does not affect the run.
struct RunChat {
  std::uint64_t step = 0;    ///< The next step after the message.
  std::uint64_t number = 0;  ///< Number of the message at its server, from 1.
  std::string from;          ///< The sender.
  std::string role;          ///< Role of the sender: `observer`, `commander` or `super_user`.
  std::string to;            ///< Kind of receiver: `all`, `role`, `user`, `team` or `robot`.
  std::string name;          ///< Name of the receiver; empty: all.
  std::string text;
};

/// The difference between a real robot and its shadow in one step.
struct ShadowRecord {
  RobotId robot;
  Pose2 X_WR;      ///< Reported pose of the robot.
  Pose2 X_WS;      ///< Pose of its shadow.
  double m = 0;    ///< Distance of the origins.
  double rad = 0;  ///< Difference of the headings, 0 to pi.
  /// By sensor: the difference of the newest readings; in metres for ranges and odometry, as a
  /// fraction for contacts. NaN: not compared yet.
  std::vector<double> readings;
};

/// A line of the console log.
struct ConsoleLine {
  SimTime time;
  LogLevel level = LogLevel::kInfo;
  std::string source;
  std::string text;
};

/// The content of one step; spans refer to the message.
template <class Item>
struct StepOf {
  SimTime time;
  std::uint64_t step = 0;
  std::vector<Item> items;
};

/// The run hash after a step of a lock-step run.
struct StepHash {
  SimTime time;
  std::uint64_t step = 0;
  std::uint64_t hash = 0;
};

/// The end of a run.
struct RunEnd {
  SimTime time;
  std::uint64_t steps = 0;
  std::optional<std::uint64_t> hash;  ///< Empty for a run with a live driver.
};

// Decoders. Errors: kParse with the topic's name if a message does not have the format of RAVE.
[[nodiscard]] Result<RunInfo> decode_run(std::span<const std::byte> message);
[[nodiscard]] Result<RunEnd> decode_end(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<RobotPose>> decode_poses(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<Percept>> decode_percepts(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<CommandRecord>> decode_commands(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<ActuatorRecord>> decode_actuators(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<RadioPacket>> decode_radio(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<RunEvent>> decode_event(std::span<const std::byte> message);
[[nodiscard]] Result<RunInput> decode_input(std::span<const std::byte> message);
/// The time is the time of the run at which it was sent.
[[nodiscard]] Result<std::pair<SimTime, RunChat>> decode_chat(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<ShadowRecord>> decode_shadow(std::span<const std::byte> message);
/// All robots with a variance; those that are not among them have none.
[[nodiscard]] Result<StepOf<PoseVariance>> decode_variances(std::span<const std::byte> message);
[[nodiscard]] Result<StepHash> decode_hash(std::span<const std::byte> message);
[[nodiscard]] Result<ConsoleLine> decode_console(std::span<const std::byte> message);

}  // namespace rave::record
