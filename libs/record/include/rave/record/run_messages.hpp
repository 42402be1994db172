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

// What is in the messages of a record, and how to read them back.
// docs/reference/recording-format.md has the table of topics. Everything comes back with the bits
// that went in.
namespace rave::record {

/// Topics of the exact streams.
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

/// Where a robot is in one step, in W.
struct RobotPose {
  RobotId robot;
  std::optional<Pose2> true_pose;      ///< Of simulated robots.
  std::optional<Pose2> reported_pose;  ///< Missing as long as a real robot has none.
  Twist2 velocity_W;                   ///< Of the origin over ground, axes of W.

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

/// As long as a robot has a variance, all of them are written again after so much time of the run.
inline constexpr std::int64_t kVariancesHold_ns = 1'000'000'000;

/// Which part of a reading: what the program was given, or one half of a hybrid before fusion.
enum class PerceptPart : std::uint8_t { kResult = 0, kReal = 1, kVirtual = 2 };

/// The bits of rave::SampleHeader.
struct ReadingHeader {
  std::int64_t stamp_ns = 0;
  std::uint32_t sequence = 0;
  std::uint32_t count = 0;
  std::uint32_t fresh = 0;
  std::uint32_t dropped = 0;

  friend bool operator==(const ReadingHeader&, const ReadingHeader&) = default;
};

/// One reading of one sensor. `records` are the bytes behind the header, as the program got them.
struct Percept {
  RobotId robot;
  DeviceId sensor;  ///< At most 65535.
  std::uint8_t kind = 0;
  PerceptPart part = PerceptPart::kResult;
  ReadingHeader header;
  std::span<const std::byte> records;
};

/// The readings that one sensor gave a row of robots at the same time: robots `first`,
/// `first` + 1, ... with the same header and as many bytes of records each, one after the other.
struct PerceptBlock {
  RobotId first;
  std::uint32_t robots = 0;
  DeviceId sensor;  ///< At most 65535.
  std::uint8_t kind = 0;
  ReadingHeader header;
  std::span<const std::byte> records;  ///< A multiple of `robots` bytes.
};

/// The commands that a row of robots gave to the same controller in one step.
struct CommandBlock {
  RobotId first;
  std::uint32_t robots = 0;
  DeviceId controller;
  std::span<const std::byte> commands;  ///< The bytes of one rave::Command for each robot.
};

/// Where a row of simulated robots is whose reported pose is the true one. Robot `first` + i has
/// its pose i * `stride_bytes` behind `X_WR`, its velocity the same behind `velocity_W`.
struct PoseBlock {
  RobotId first;
  std::uint32_t robots = 0;
  const Pose2* X_WR = nullptr;
  const Twist2* velocity_W = nullptr;
  std::size_t stride_bytes = 0;
};

/// One command that a controller accepted; the bytes of rave::Command.
struct CommandRecord {
  RobotId robot;
  DeviceId controller;
  std::span<const std::byte> command;
};

/// What reached an actuator, behind the controllers: the bytes of rave::Command. It holds until the
/// next one for the same actuator, so only changes are recorded.
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

/// Something that happened: a contact, a guard that stopped a robot, an edit of the world.
struct RunEvent {
  RobotId robot;     ///< None: it concerns the run.
  std::string kind;  ///< `contact`, `guard_stop`, `device_lost`, ...
  std::string text;
  std::vector<double> values;  ///< Meaning by kind.
};

/// What somebody asked of the run between two steps, and was done: enough to ask for it again.
struct RunInput {
  std::uint64_t step = 0;  ///< The step that comes next.
  /// `stop`, `release`, `arm`, `set`, `hand_over`; of obstacles `add`, `move`, `remove`; of people
  /// to robots `drive`, `goal`, `path`, `cancel`, `text`, `place`.
  std::string kind;
  std::string robot;  ///< Empty: all of them.
  std::string key;    ///< Of `set`: such as `program.max_speed_mps`; of `remove`: which one.
  std::string value;  ///< Of `set`, `hand_over`, `add` and `move`: as in a file; of orders: what.
  std::string by{};   ///< Who asked; empty: nobody with a name, or an older record.

  friend bool operator==(const RunInput&, const RunInput&) = default;
};

/// What somebody said to people, or to robots and the people who see them. It changes nothing.
struct RunChat {
  std::uint64_t step = 0;    ///< The step that comes next.
  std::uint64_t number = 0;  ///< Counts the lines of the server that it was said at, from 1 on.
  std::string from;          ///< Who said it,
  std::string role;          ///< `observer`, `commander` or `super_user`,
  std::string to;            ///< to whom: `all`, `role`, `user`, `team` or `robot`,
  std::string name;          ///< of this name; empty: all.
  std::string text;
};

/// How far a real robot and its shadow are from each other in one step.
struct ShadowRecord {
  RobotId robot;
  Pose2 X_WR;      ///< Of the robot, as reported.
  Pose2 X_WS;      ///< Of its shadow.
  double m = 0;    ///< Between the origins.
  double rad = 0;  ///< Between the headings, 0 to pi.
  /// By sensor: of the newest readings; in metres of ranges and odometry, as a share of contacts.
  /// NaN: not compared so far.
  std::vector<double> readings;
};

/// A line of the console.
struct ConsoleLine {
  SimTime time;
  LogLevel level = LogLevel::kInfo;
  std::string source;
  std::string text;
};

/// The content of one step; spans point into the message.
template <class Item>
struct StepOf {
  SimTime time;
  std::uint64_t step = 0;
  std::vector<Item> items;
};

/// The run hash as it was after a step of a lock-step run.
struct StepHash {
  SimTime time;
  std::uint64_t step = 0;
  std::uint64_t hash = 0;
};

/// How a run ended.
struct RunEnd {
  SimTime time;
  std::uint64_t steps = 0;
  std::optional<std::uint64_t> hash;  ///< None for a run with a live driver.
};

// Errors: kParse with the topic's name if a message is not as RAVE writes it.
[[nodiscard]] Result<RunInfo> decode_run(std::span<const std::byte> message);
[[nodiscard]] Result<RunEnd> decode_end(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<RobotPose>> decode_poses(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<Percept>> decode_percepts(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<CommandRecord>> decode_commands(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<ActuatorRecord>> decode_actuators(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<RadioPacket>> decode_radio(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<RunEvent>> decode_event(std::span<const std::byte> message);
[[nodiscard]] Result<RunInput> decode_input(std::span<const std::byte> message);
/// The time is that of the run when it was said.
[[nodiscard]] Result<std::pair<SimTime, RunChat>> decode_chat(std::span<const std::byte> message);
[[nodiscard]] Result<StepOf<ShadowRecord>> decode_shadow(std::span<const std::byte> message);
/// All robots with a variance; those that are not among them have none.
[[nodiscard]] Result<StepOf<PoseVariance>> decode_variances(std::span<const std::byte> message);
[[nodiscard]] Result<StepHash> decode_hash(std::span<const std::byte> message);
[[nodiscard]] Result<ConsoleLine> decode_console(std::span<const std::byte> message);

}  // namespace rave::record
