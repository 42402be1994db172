// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "rave/base/result.hpp"
#include "rave/gui_server/command.hpp"
#include "rave/gui_server/rights.hpp"
#include "rave/maps/map_tile.hpp"
#include "rave/onlook/asked.hpp"
#include "rave/probe/probes.hpp"

// A source provides what the GUI Server shows: a recording, or a run. Plain values; SI units, frame
// W, angles in radians, times in seconds of the run.
namespace rave::gui_server {

/// A page draws trails of this many seconds; missing poses are sent with this spacing.
inline constexpr double kPast_s = 20;
inline constexpr double kPastSpacing_s = 0.2;
/// How long after its beginning a contact counts as lasting.
inline constexpr double kTouch_s = 0.5;

/// A panel that the scenario supplies, as a file that the page loads.
struct PageComponent {
  std::string name;  ///< File name without folder and extension.
  std::filesystem::path file;
  std::set<Role> roles;  ///< The roles that get it, besides super-users.

  [[nodiscard]] bool is_for(Role role) const {
    return role == Role::kSuperUser || roles.contains(role);
  }
};

/// The name and origin of a run.
struct RunAbout {
  bool live = false;  ///< In progress; otherwise a recording.
  bool none = false;  ///< There is no run: pages show what can be started.
  std::string name;
  std::string started;  ///< ISO 8601; empty if unknown.
  double step_s = 0;
  std::uint64_t seed = 0;
  std::string hash;  ///< 16 hexadecimal digits; empty: none.
  bool lock_step = true;
  std::filesystem::path recording;  ///< Empty: none.
  std::uint64_t recording_bytes = 0;
  bool recording_whole = false;
  std::vector<std::string> notes;  ///< What differs from the recorded run, for who opens it.
  double begin_s = 0;
  double end_s = 0;
  double duration_s = 0;
  /// Orders may go through the server if there is no direct line to a host.
  bool relay = false;
  std::vector<PageComponent> components;
  Rights rights;  ///< The default rights with the changes of the scenario.
};

/// Bits of RobotState::flags, as in pose frames.
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
  double speed_mps = 0;  ///< Over ground; forward is positive.
  std::uint16_t flags = 0;
  /// Variance of the reported pose: of x and y, and of the heading. 0: unknown, as in recordings of
  /// earlier versions.
  float variance_xy_m2 = 0;
  float variance_yaw_rad2 = 0;
  void set(bool on, RobotFlag flag) {
    flags = static_cast<std::uint16_t>(on ? flags | flag : flags & ~flag);
  }
  friend bool operator==(const RobotState&, const RobotState&) = default;
};

/// The states of all robots at one time, by index of the roster.
struct PosesAt {
  /// Serial number of a picture that several pages share; 0: for one page only.
  std::uint32_t serial = 0;
  double time_s = 0;
  std::uint64_t step = 0;
  std::vector<RobotState> robots;
  /// True poses with the same index: place and kKnown only. Empty: not requested, or of no robot
  /// known.
  std::vector<RobotState> truth{};
  /// When the server received this state: microseconds of Unix time modulo 2^32. 0: a recording.
  std::uint32_t taken_us = 0;
};

/// A reading, and a sensor that a page shows.
using onlook::LookedAt;
using onlook::ReadingAt;

/// A chat message in a recording.
struct ChatText {
  std::uint64_t number = 0;  ///< From 1.
  double t_s = 0;            ///< Time of the run.
  std::string from;
  std::string role;  ///< `observer`, `commander` or `super_user`.
  std::string to;    ///< `all`, `role`, `user`, `team` or `robot`.
  std::string name;  ///< Name of the receiver, of the kind `to`.
  std::string text;
};

/// An event of the log, with repetitions combined.
struct LogEvent {
  double t_s = 0;
  double until_s = 0;
  std::uint32_t count = 1;
  std::string kind;
  enum class Level : std::uint8_t { kInfo, kWarn, kAlert } level = Level::kInfo;
  std::string text;
  std::vector<std::uint32_t> slots;
};

/// The position of one page in time. One thread.
class Cursor {
 public:
  virtual ~Cursor() = default;
  /// Moves to the newest state at or before `time_s`, forwards or backwards. Errors: kIo, kParse
  /// (damaged data; other times may still work).
  [[nodiscard]] virtual Status go_to(double time_s) = 0;
  [[nodiscard]] virtual const PosesAt& poses() const noexcept = 0;
  /// The newest readings of `sensors` at this time.
  [[nodiscard]] virtual std::vector<ReadingAt> readings(std::span<const LookedAt> sensors,
                                                        bool parts) = 0;
  /// The message `scene_change` from the initial bodies, or those of the last call, to those of
  /// this time. Empty: nothing changed, or the source provides bodies for all pages together.
  [[nodiscard]] virtual std::string take_bodies() { return {}; }
};

/// The time that a page shows, and its progress.
struct PlayState {
  enum class Kind : std::uint8_t { kRunning, kPaused, kWaiting, kEnded } kind = Kind::kRunning;
  double now_s = 0;
  double begin_s = 0;     ///< Earliest time that can be shown.
  double end_s = 0;       ///< Latest known time.
  double duration_s = 0;  ///< Planned duration; 0: an open end.
  double pace = 1;        ///< Requested pace; 0: no limit.
  double speed = 0;       ///< Seconds of the run per second of wall time.
  std::string reason{};   ///< Reason for kWaiting and kEnded.
  /// Changes with each new picture; equal ones need not be sent again.
  std::uint64_t picture = 0;
  bool jumped = false;  ///< The page has no past poses for trails.
};

/// A request of a page to control time.
struct TransportMessage {
  enum class Do : std::uint8_t { kPlay, kPause, kStep, kSeek, kPace } what = Do::kPlay;
  double value = 0;  ///< Finite. kStep: number of steps; kSeek: seconds of the run; kPace: factor.
};

/// The time of one page: its own in a recording, that of the run in a live one. One thread.
class Playhead {
 public:
  using Clock = std::chrono::steady_clock;
  virtual ~Playhead() = default;
  /// Executes a request. Returns the reason if refused; empty if done.
  virtual std::string take(const TransportMessage& transport, Clock::time_point now) = 0;
  virtual PlayState look(Clock::time_point now) = 0;
};

/// The requests that pages may send, by their names in messages (`play`, `stop` ...), and reasons
/// why others are refused.
struct Powers {
  std::vector<std::string> may;
  std::map<std::string, std::string> why_not;
};

/// A request to stop or release robots.
struct HaltMessage {
  bool stop = true;                  ///< True: stop; false: release.
  std::vector<std::uint32_t> slots;  ///< Empty: all robots.
};

/// A map that can be shown: the local map of a robot, or a global one.
struct MapName {
  std::uint32_t slot = maps::kNoRobot;  ///< Index of the robot.
  std::string name;                     ///< Name of the robot or of the global map.

  [[nodiscard]] bool global() const noexcept { return slot == maps::kNoRobot; }
  friend auto operator<=>(const MapName&, const MapName&) = default;
};

/// A piece of a map.
struct TileShown {
  std::uint64_t revision = 0;  ///< Changes with every change; unique over all tiles of a source.
  SimTime stamp;
  std::vector<std::uint8_t> cells;  ///< As in maps::MapTile.
};

/// The present content of a map.
struct MapShown {
  maps::MapFrame frame;
  SimTime stamp;  ///< Stamp of the newest reading in it.
  /// By row and column of the tile; unknown tiles are missing.
  std::map<std::pair<std::uint32_t, std::uint32_t>, TileShown> tiles;
};

/// A request to try a virtual sensor on a robot.
struct ProbeRequest {
  std::uint32_t slot = 0;
  std::string name;
  std::string driver;
  Pose2 X_RS;
  double z_m = 0;
  std::vector<std::pair<std::string, std::string>> params;  ///< Values as in a file.
  bool without_obstacles = false;  ///< The user must not learn about virtual obstacles.
};

/// A created probe: the request to the hosts, with the number of the robot in the run.
struct ProbeMade {
  probe::Asked asked;
  std::string text;         ///< The entry for `sensors:` of a robot file.
  std::string sensor_json;  ///< As in a roster.
};

/// The data that all pages together need.
struct Audience {
  double max_hz = 0;                ///< Poses per second that pages need; 0: none.
  bool truth = false;               ///< A page needs true poses.
  std::vector<LookedAt> looked_at;  ///< Ascending, without duplicates.
  bool parts = false;               ///< Also the halves of hybrid sensors.
  /// Robots whose local maps are needed; ascending, without duplicates.
  std::vector<std::uint32_t> maps;
  std::vector<probe::Asked> probes;  ///< Ascending, without duplicates.

  friend bool operator==(const Audience&, const Audience&) = default;
};

/// Used in one thread, that of the server.
class Source {
 public:
  /// Receives the result of a request, now or later.
  using Reply = std::function<void(bool good, std::string text)>;

  virtual ~Source() = default;
  [[nodiscard]] virtual const RunAbout& about() const noexcept = 0;
  [[nodiscard]] virtual Powers powers() const = 0;
  /// The arrays `bodies` of a message `scene` and `robots` of a message `roster`, as JSON.
  [[nodiscard]] virtual const std::string& bodies_json() const noexcept = 0;
  [[nodiscard]] virtual const std::string& robots_json() const noexcept = 0;
  /// The kinds of bodies that are withheld, as a JSON array.
  [[nodiscard]] virtual std::string hidden_kinds_json() const { return "[]"; }
  [[nodiscard]] virtual std::uint32_t robot_count() const noexcept = 0;
  [[nodiscard]] virtual std::span<const LogEvent> events() const noexcept = 0;
  [[nodiscard]] virtual std::unique_ptr<Cursor> open_cursor() = 0;
  [[nodiscard]] virtual std::unique_ptr<Playhead> open_playhead() = 0;

  // A run in progress.
  /// Descriptor of the Bell that rings when tick() would show a newer state; negative:
  /// none rings.
  [[nodiscard]] virtual int bell() const noexcept { return -1; }
  /// Called when the bell rings, and at least 25 times a second, before the pages are served.
  virtual void tick(Playhead::Clock::time_point /*now*/, const Audience& /*audience*/) {}
  /// Changes whenever events were added or changed. events_changed_since() returns the index of the
  /// first such event since an earlier revision.
  [[nodiscard]] virtual std::uint64_t events_revision() const noexcept { return 0; }
  [[nodiscard]] virtual std::size_t events_changed_since(
      std::uint64_t /*revision*/) const noexcept {
    return 0;
  }
  /// Changes with the bodies of the scene. bodies_changed_since() returns the message with the
  /// changes since an earlier revision.
  [[nodiscard]] virtual std::uint64_t bodies_revision() const noexcept { return 0; }
  [[nodiscard]] virtual std::string bodies_changed_since(std::uint64_t /*revision*/) const {
    return {};
  }
  /// The array `hosts` of the message with that name, and a revision that changes with it; 0: the
  /// run has no hosts.
  [[nodiscard]] virtual std::uint64_t hosts_revision() const noexcept { return 0; }
  [[nodiscard]] virtual const std::string& hosts_json() const noexcept {
    static const std::string kNone = "[]";
    return kNone;
  }
  // Maps: always the present ones, whatever time a page shows.
  /// The maps that can be shown, and a revision that changes with the list; 0: none.
  [[nodiscard]] virtual std::vector<MapName> map_names() const { return {}; }
  [[nodiscard]] virtual std::uint64_t map_names_revision() const noexcept { return 0; }
  /// Changes with every tile of any map.
  [[nodiscard]] virtual std::uint64_t maps_revision() const noexcept { return 0; }
  /// The content of a map; a local map is identified by its slot only. Null: no such map, or
  /// nothing known yet. Valid until the next tick().
  [[nodiscard]] virtual const MapShown* map(const MapName& /*name*/) const { return nullptr; }

  // Probes: virtual sensors for trial. Their readings come with those of the cursor, by their
  // number.
  /// The available virtual sensors: the array `drivers` of a message `catalogue`.
  [[nodiscard]] virtual std::string virtual_sensors_json() { return "[]"; }
  /// Checks and prepares a probe. Sensing begins when the audience of tick() contains it. Errors:
  /// kState (not possible here), kNotFound, kInvalidArgument.
  [[nodiscard]] virtual Result<ProbeMade> probe(const ProbeRequest& request);
  /// The chat of a recorded run, oldest first; slots are robots.
  [[nodiscard]] virtual std::span<const ChatText> chat() const noexcept { return {}; }
  /// Adds a chat message to the recording of the run.
  virtual void keep_chat(const ChatText& /*said*/) {}

  /// Stops or releases robots at once; a stop needs no lease.
  virtual void halt(const HaltMessage& halt, const Author& author, Reply reply) = 0;

  /// The result of a command for one of its robots; for an obstacle with kNoSlot.
  static constexpr std::uint32_t kNoSlot = 0xffffffff;
  using SlotReply = std::function<void(std::uint32_t slot, bool good, std::string text)>;
  /// Executes a command. Calls `reply` once for each robot of the command, now or later.
  virtual void command(const CommandMessage& command, const Author& /*author*/,
                       const SlotReply& reply);
  /// Panels that the scenario supplies.
  [[nodiscard]] virtual const std::vector<PageComponent>& components() const {
    return about().components;
  }
  /// Reads the list of these panels again if its file has changed; called when a page comes. Error:
  /// of the file; the panels stay as they were.
  [[nodiscard]] virtual Status refresh_components() { return {}; }

  /// Changes whenever a lease changes. leases_changed_since() returns the changes since an earlier
  /// revision (0: all).
  [[nodiscard]] virtual std::uint64_t leases_revision() const noexcept { return 0; }
  [[nodiscard]] virtual std::vector<DriveState> leases_changed_since(
      std::uint64_t /*revision*/) const {
    return {};
  }
};

/// A source that plays a recording. Errors: those of record::open_run() and McapReader::open(),
/// kParse (not written by RAVE), and those of the scenario in it (a missing map).
[[nodiscard]] Result<std::shared_ptr<Source>> open_recording(const std::filesystem::path& file);

}  // namespace rave::gui_server
