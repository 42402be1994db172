// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/gui_server/command.hpp"
#include "rave/gui_server/rights.hpp"
#include "rave/maps/map_tile.hpp"
#include "rave/probe/probes.hpp"

// What the GUI Server shows comes from a source: a recording, or a run. Plain values; SI units,
// frame W, angles in radians, times in seconds of the run.
namespace rave::gui_server {

/// A page draws trails of so many seconds; it gets what it has not seen of them at this spacing.
inline constexpr double kPast_s = 20;
inline constexpr double kPastSpacing_s = 0.2;
/// A contact is told when it begins; so long it counts as going on.
inline constexpr double kTouch_s = 0.5;

/// A panel that the scenario brings along, as a file that the page loads.
struct PageComponent {
  std::string name;  ///< Of the file, without folder and ending.
  std::filesystem::path file;
  std::set<Role> roles;  ///< Who gets it, beside super-users.

  [[nodiscard]] bool is_for(Role role) const {
    return role == Role::kSuperUser || roles.contains(role);
  }
};

/// What the run is called and where it comes from.
struct RunAbout {
  bool live = false;  ///< It goes on; otherwise this is its recording.
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
  /// Orders may go through the server where a page has no direct line to a host.
  bool relay = false;
  std::vector<PageComponent> components;
  Rights rights;  ///< The usual ones, with what the scenario changes.
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
  /// Of the reported pose: of each of x and y, and of the heading. 0: not known. Live runs alone.
  float variance_xy_m2 = 0;
  float variance_yaw_rad2 = 0;
};

/// Where all robots are at one moment; by index of the roster.
struct PosesAt {
  std::uint32_t serial = 0;  ///< Of a picture that several pages share; 0: it is of one page alone.
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

/// Something that a person said, as a record has it.
struct ChatText {
  std::uint64_t number = 0;  ///< From 1 on.
  double t_s = 0;            ///< Of the run.
  std::string from;
  std::string role;  ///< `observer`, `commander` or `super_user`.
  std::string to;    ///< `all`, `role`, `user`, `team` or `robot`.
  std::string name;  ///< Of whom `to` says.
  std::string text;
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
  /// The message `scene_change` that leads from the bodies of the start, or of the last call, to
  /// those of this moment; empty: nothing changed, or they are those of the source for everybody.
  [[nodiscard]] virtual std::string take_bodies() { return {}; }
};

/// Where a page is in the time of a run, and what that time does.
struct PlayState {
  enum class Kind : std::uint8_t { kRunning, kPaused, kWaiting, kEnded } kind = Kind::kRunning;
  double now_s = 0;
  double begin_s = 0;     ///< Earliest moment that can be shown.
  double end_s = 0;       ///< Latest moment that is known.
  double duration_s = 0;  ///< Planned.
  double pace = 1;        ///< What was asked for; 0: as fast as it goes.
  double speed = 0;       ///< Seconds of the run per second on the wall.
  std::string reason{};   ///< Of kWaiting and kEnded.
  /// Changes with each new picture; equal ones need not be sent again.
  std::uint64_t picture = 0;
  bool jumped = false;  ///< The page has no past to draw trails with.
};

/// What a page asks of the time of a run.
struct TransportMessage {
  enum class Do : std::uint8_t { kPlay, kPause, kStep, kSeek, kPace } what = Do::kPlay;
  double value = 0;  ///< Finite. kStep: how many; kSeek: seconds of the run; kPace: factor.
};

/// The time of one page: its own in a recording, that of the run in a live one. One thread.
class Playhead {
 public:
  using Clock = std::chrono::steady_clock;
  virtual ~Playhead() = default;
  /// Returns why not; empty: it is done.
  virtual std::string take(const TransportMessage& transport, Clock::time_point now) = 0;
  virtual PlayState look(Clock::time_point now) = 0;
};

/// What pages may ask for, by the words of the messages (`play`, `stop` ...), and why not.
struct Powers {
  std::vector<std::string> may;
  std::map<std::string, std::string> why_not;
};

/// What is asked of robots.
struct HaltMessage {
  bool stop = true;                  ///< Otherwise: release.
  std::vector<std::uint32_t> slots;  ///< Empty: all robots.
};

/// A map that can be looked at: the local one of a robot, or a global one.
struct MapName {
  std::uint32_t slot = maps::kNoRobot;  ///< Of the robot.
  std::string name;                     ///< Of the robot, or of the global map.

  [[nodiscard]] bool global() const noexcept { return slot == maps::kNoRobot; }
  friend auto operator<=>(const MapName&, const MapName&) = default;
};

/// A piece of a map.
struct TileShown {
  std::uint64_t revision = 0;  ///< Another number whenever it changed, of all tiles of a source.
  SimTime stamp;
  std::vector<std::uint8_t> cells;  ///< As in maps::MapTile.
};

/// A map as it is known at present.
struct MapShown {
  maps::MapFrame frame;
  SimTime stamp;  ///< Of the newest reading in it.
  /// By row and column of the tile; where nothing is known there is none.
  std::map<std::pair<std::uint32_t, std::uint32_t>, TileShown> tiles;
};

/// A virtual sensor that somebody wants to try on a robot.
struct ProbeWish {
  std::uint32_t slot = 0;
  std::string name;
  std::string driver;
  Pose2 X_RS;
  double z_m = 0;
  std::vector<std::pair<std::string, std::string>> params;  ///< Values as a file has them.
  bool without_obstacles = false;  ///< Who wishes it must not learn of virtual obstacles.
};

/// What became of it: what hosts are asked for, with the number of the robot in the run.
struct ProbeMade {
  probe::Asked asked;
  std::string text;         ///< The entry for `sensors:` of a robot file.
  std::string sensor_json;  ///< As in a roster.
};

/// What all pages together look at.
struct Audience {
  bool any = false;                  ///< A page wants poses.
  std::vector<LookedAt> looked_at;   ///< Ascending, without repetitions.
  bool parts = false;                ///< Also the halves of hybrid sensors.
  std::vector<std::uint32_t> maps;   ///< Robots whose local maps; the same.
  std::vector<probe::Asked> probes;  ///< The same.
};

/// One thread, which is that of the server.
class Source {
 public:
  /// What came of something that was asked. May come later.
  using Reply = std::function<void(bool good, std::string text)>;

  virtual ~Source() = default;
  [[nodiscard]] virtual const RunAbout& about() const noexcept = 0;
  [[nodiscard]] virtual Powers powers() const = 0;
  /// The arrays `bodies` of a message `scene` and `robots` of a message `roster`, as JSON.
  [[nodiscard]] virtual const std::string& bodies_json() const noexcept = 0;
  [[nodiscard]] virtual const std::string& robots_json() const noexcept = 0;
  /// Kinds of bodies that are withheld.
  [[nodiscard]] virtual std::string hidden_kinds_json() const { return "[]"; }
  [[nodiscard]] virtual std::uint32_t robot_count() const noexcept = 0;
  [[nodiscard]] virtual std::span<const LogEvent> events() const noexcept = 0;
  [[nodiscard]] virtual std::unique_ptr<Cursor> open_cursor() = 0;
  [[nodiscard]] virtual std::unique_ptr<Playhead> open_playhead() = 0;

  // A run that goes on.
  /// Called some 60 times a second, before the pages are served.
  virtual void tick(Playhead::Clock::time_point /*now*/, const Audience& /*audience*/) {}
  /// Another number whenever events came or changed; since a number of before, those from this
  /// index on did.
  [[nodiscard]] virtual std::uint64_t events_revision() const noexcept { return 0; }
  [[nodiscard]] virtual std::size_t events_changed_since(
      std::uint64_t /*revision*/) const noexcept {
    return 0;
  }
  /// The same of the bodies of the scene, with the message that says what changed.
  [[nodiscard]] virtual std::uint64_t bodies_revision() const noexcept { return 0; }
  [[nodiscard]] virtual std::string bodies_changed_since(std::uint64_t /*revision*/) const {
    return {};
  }
  /// The array `hosts` of a message of that name, and another number whenever it changed; 0: the
  /// run has no hosts.
  [[nodiscard]] virtual std::uint64_t hosts_revision() const noexcept { return 0; }
  [[nodiscard]] virtual const std::string& hosts_json() const noexcept {
    static const std::string kNone = "[]";
    return kNone;
  }
  // Maps. They are those of the present, wherever a page is in time.
  /// What can be looked at, and another number whenever that changed; 0: there are none.
  [[nodiscard]] virtual std::vector<MapName> map_names() const { return {}; }
  [[nodiscard]] virtual std::uint64_t map_names_revision() const noexcept { return 0; }
  /// Another number whenever a tile of any map came.
  [[nodiscard]] virtual std::uint64_t maps_revision() const noexcept { return 0; }
  /// A local map is found by its slot alone. Null: there is no such map, or nothing is known of it
  /// yet. Holds until the next tick().
  [[nodiscard]] virtual const MapShown* map(const MapName& /*name*/) const { return nullptr; }

  // Virtual sensors that are tried. Their readings come with those of the cursor, by their number.
  /// Which there are: the array `drivers` of a message `catalogue`.
  [[nodiscard]] virtual std::string virtual_sensors_json() { return "[]"; }
  /// Nothing senses yet: that begins when the audience of tick() has it. Errors: kState (nobody
  /// can), kNotFound, kInvalidArgument.
  [[nodiscard]] virtual Result<ProbeMade> probe(const ProbeWish& wish);
  /// What people said in the run that this is the record of, oldest first; slots are robots.
  [[nodiscard]] virtual std::span<const ChatText> chat() const noexcept { return {}; }
  /// Puts what was said into the record of the run.
  virtual void keep_chat(const ChatText& /*said*/) {}

  /// Stops and releases robots, at once and without a lease to stop.
  virtual void halt(const HaltMessage& halt, const Author& author, Reply reply) = 0;

  /// What came of a command for one of its robots; of an obstacle with kNoSlot.
  static constexpr std::uint32_t kNoSlot = 0xffffffff;
  using SlotReply = std::function<void(std::uint32_t slot, bool good, std::string text)>;
  /// Calls `reply` once for each robot of the command, now or later.
  virtual void command(const CommandMessage& command, const Author& /*author*/,
                       const SlotReply& reply);
  /// Another number whenever it changed who drives which robot; since a number of before (0: ever),
  /// these did.
  [[nodiscard]] virtual std::uint64_t leases_revision() const noexcept { return 0; }
  [[nodiscard]] virtual std::vector<DriveState> leases_changed_since(
      std::uint64_t /*revision*/) const {
    return {};
  }
};

/// Plays the record of a run. Errors: those of record::open_run() and McapReader::open(), kParse
/// (not written by RAVE), and those of the scenario in it (a map that is missing).
[[nodiscard]] Result<std::shared_ptr<Source>> open_recording(const std::filesystem::path& file);

}  // namespace rave::gui_server
