// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "rave/gui_server/source.hpp"
#include "run/map_book.hpp"

namespace rave::gui_server::testing {

/// A run that goes on for ever, with two robots of team green and two of team blue. What is blue,
/// and the virtual obstacle, has names and numbers that can be searched for.
class FakeRun : public Source {
 public:
  static constexpr double kSecretX_m = 7777.25;
  static constexpr double kOpenTruth_m = 5512.5;  ///< True place of robots of team green.
  static constexpr double kSecretTruth_m = 6666.5;
  static constexpr float kOpenVariance_m2 = 0.40625F;
  static constexpr float kSecretVariance_m2 = 3333.75F;
  static constexpr float kSecretRange_m = 1234.5F;
  static constexpr float kOpenRange_m = 2.5F;
  static constexpr float kHalfRange_m = 987.5F;
  static constexpr std::uint32_t kProbeNumber = probe::kProbeBit | 7U;
  static constexpr double kOpenGap_m = 0.3125;
  static constexpr double kSecretGap_m = 4711.5;
  static constexpr const char* kTwinText = "real -> simulated at the door";
  inline static const std::vector<std::uint8_t> kOpenCells{1, 2, 3, 4, 5, 6, 7, 8};
  inline static const std::vector<std::uint8_t> kGlobalCells{11, 12, 13, 14, 15, 16, 17, 18};
  inline static const std::vector<std::uint8_t> kSecretCells{91, 92, 93, 94, 95, 96, 97, 98};

  FakeRun() {
    facts.live = facts.relay = true;
    facts.name = "fake";
    facts.step_s = 0.01;
    facts.recording = "/nowhere/fake.mcap";
    for (const auto& [name, team] : {std::pair("walker-1", "green"), std::pair("spy-2", "blue"),
                                     std::pair("walker-3", "green"), std::pair("spy-4", "blue")}) {
      robots_ += robots_.empty() ? "[" : ",";
      robots_ +=
          std::string(R"({"name":")") + name + R"(","team":")" + team +
          R"(","kind":"simulated","word":"","recorded":false,"program":"","drivers":[],)" +
          R"("shapes":[{"disc":[0,0,0.2],"z":[0,0.3]}],)" +
          R"("sensors":[{"name":"scan","kind":"ranges","origin":"hybrid","driver":"",)" +
          R"("mount":[0.1,0,0],"z":0.15,"period_s":0.1,"fields":[{"name":"range_m","label":"range","unit":"m","format":"float32"}],)" +
          R"("range":[0,10],"bearings":[0],"cone":0}]})";
    }
    robots_ += "]";
    events_.push_back({1, 1, 1, "stopped", LogEvent::Level::kWarn, "spy-2: stopped", {1}});
    events_.push_back(
        {2, 2, 1, "contact", LogEvent::Level::kInfo, "walker-1 and spy-2 touch", {0, 1}});
    events_.push_back({3, 3, 1, "hint", LogEvent::Level::kInfo, "walker-1: saw spy-4", {0}});
    events_.push_back({4, 4, 1, "hint", LogEvent::Level::kInfo, "walker-1: at home", {0}});
    maps_ = MapBook(robots_, "[]");
    // Local maps, of which one has a pattern that can be searched for, and a global one.
    for (std::uint32_t robot = 0; robot < 4; ++robot) {
      maps_.add(
          {"", robot, {0.1, {}, 4, 2}, 0, 0, 1, {}, robot % 2 == 0 ? kOpenCells : kSecretCells});
    }
    maps_.add({"all", maps::kNoRobot, {0.5, {}, 4, 2}, 0, 0, 1, {}, kGlobalCells});
    maps_.add({"of spy-2", maps::kNoRobot, {0.5, {}, 4, 2}, 0, 0, 1, {}, kSecretCells});
    maps_.add({"global blue", maps::kNoRobot, {0.5, {}, 4, 2}, 0, 0, 1, {}, kSecretCells});
    for (int i = 0; i < 4; ++i) {
      poses_.robots.push_back({i % 2 == 0 ? 1.0 : kSecretX_m, 0, 0, 0, kKnown});
      poses_.robots.back().variance_xy_m2 = i % 2 == 0 ? kOpenVariance_m2 : kSecretVariance_m2;
      // There whether or not somebody asks: no more than a part of it may be sent.
      poses_.truth.push_back({i % 2 == 0 ? kOpenTruth_m : kSecretTruth_m, 0, 0, 0, kKnown});
    }
  }

  [[nodiscard]] const RunAbout& about() const noexcept override { return facts; }
  [[nodiscard]] Powers powers() const override {
    return {{"play", "pace", "step", "stop", "release", "true_pose", "readings", "hybrid_parts",
             "obstacles", "log", "recording", "command", "edit", "chat", "maps", "probe"},
            {}};
  }
  [[nodiscard]] const std::string& bodies_json() const noexcept override { return bodies_; }
  [[nodiscard]] const std::string& robots_json() const noexcept override { return robots_; }
  [[nodiscard]] std::uint32_t robot_count() const noexcept override { return 4; }
  [[nodiscard]] std::span<const LogEvent> events() const noexcept override { return events_; }
  [[nodiscard]] std::unique_ptr<Cursor> open_cursor() override {
    return std::make_unique<FakeCursor>(*this);
  }
  [[nodiscard]] std::unique_ptr<Playhead> open_playhead() override {
    return std::make_unique<FakePlayhead>(*this);
  }
  [[nodiscard]] std::vector<MapName> map_names() const override { return maps_.names(); }
  [[nodiscard]] std::uint64_t map_names_revision() const noexcept override { return 1; }
  [[nodiscard]] std::uint64_t maps_revision() const noexcept override { return 1; }
  [[nodiscard]] const MapShown* map(const MapName& name) const override { return maps_.find(name); }
  void tick(Playhead::Clock::time_point /*now*/, const Audience& audience) override {
    asked_truth = audience.truth;
    for (const std::uint32_t robot : audience.maps) asked_maps |= 1 << robot;
    int robots = 0;
    for (const probe::Asked& asked : audience.probes) robots |= 1 << asked.robot;
    probed = robots;
    ++poses_.serial;
    poses_.time_s = 0.01 * poses_.serial;
  }
  [[nodiscard]] std::string virtual_sensors_json() override {
    return R"([{"name":"virtual_laser","summary":"","kind":"ranges","parameters":[]}])";
  }
  [[nodiscard]] Result<ProbeMade> probe(const ProbeRequest& request) override {
    const std::lock_guard lock(mutex_);
    requests_.push_back(request);
    return ProbeMade{
        {request.slot, kProbeNumber, "{}"},
        "  - name: p\n",
        R"({"name":"p","kind":"ranges","origin":"virtual","driver":"virtual_laser",)"
        R"("mount":[0,0,0],"z":0,"period_s":0.1,"fields":[{"name":"range_m","label":"range","unit":"m","format":"float32"}]})"};
  }
  /// What pages requested to try, by robots of the run.
  [[nodiscard]] std::vector<ProbeRequest> requests() {
    const std::lock_guard lock(mutex_);
    return requests_;
  }
  void halt(const HaltMessage& halt, const Author& /*author*/, Reply reply) override {
    halted_robots += halt.slots.empty() ? 4 : static_cast<int>(halt.slots.size());
    reply(true, "stopped walker-1 and spy-2");
  }

  void command(const CommandMessage& command, const Author& author,
               const SlotReply& reply) override {
    const std::lock_guard lock(mutex_);
    commands_.emplace_back(command, author);
    if (command.of_obstacle()) return reply(kNoSlot, true, "added");
    for (const std::uint32_t slot : command.slots) {
      reply(slot, slot != 2, slot == 2 ? "`spy-2` drives walker-3" : "taken by spy-4");
    }
  }
  [[nodiscard]] Status refresh_components() override {
    const std::lock_guard lock(mutex_);
    if (!components_error_.empty()) return fail(ErrorCode::kParse, "{}", components_error_);
    if (!next_components_.empty()) facts.components = std::exchange(next_components_, {});
    return {};
  }
  /// What the file of the panels says from now on.
  void change_components(std::vector<PageComponent> next, std::string error) {
    const std::lock_guard lock(mutex_);
    next_components_ = std::move(next);
    components_error_ = std::move(error);
  }
  [[nodiscard]] std::uint64_t leases_revision() const noexcept override { return 1; }
  [[nodiscard]] std::vector<DriveState> leases_changed_since(
      std::uint64_t revision) const override {
    if (revision > 0) return {};
    DriveState open{0, "ben", {"drive", "goal"}, "goal 1.00, 2.00", lease_page};
    open.hand_over = runtime::RunStatus::HandOver{};
    open.hand_over->last = kTwinText;
    open.shadow = runtime::RunStatus::Shadow{};
    open.shadow->m = kOpenGap_m;
    DriveState secret{1, "spy-lord", {"drive"}, "goal 47.11, 2.00"};
    secret.hand_over = runtime::RunStatus::HandOver{};
    secret.shadow = runtime::RunStatus::Shadow{};
    secret.shadow->m = kSecretGap_m;
    return {open, secret};
  }
  [[nodiscard]] std::span<const ChatText> chat() const noexcept override { return recorded; }
  void keep_chat(const ChatText& said) override {
    const std::lock_guard lock(mutex_);
    kept_.push_back(said);
  }
  /// What was said, for the record.
  [[nodiscard]] std::vector<ChatText> kept() {
    const std::lock_guard lock(mutex_);
    return kept_;
  }
  /// What robots and obstacles were asked, with who asked.
  [[nodiscard]] std::vector<std::pair<CommandMessage, Author>> commands() {
    const std::lock_guard lock(mutex_);
    return commands_;
  }

  RunAbout facts;
  std::vector<ChatText> recorded;  ///< Of the record that this is, if it is one.
  std::atomic<int> halted_robots = 0;
  std::atomic<int> asked_maps = 0;  ///< A bit of each robot whose local map was asked for.
  std::atomic<bool> asked_truth = false;
  std::atomic<int> probed = 0;  ///< A bit of each robot that something is tried on now.
  std::atomic<std::uint64_t> lease_page = 0;  ///< On which page ben drives.
  std::atomic<int> moved = 0;                 ///< How often somebody moved the time of the run.

 private:
  class FakeCursor final : public Cursor {
   public:
    explicit FakeCursor(const FakeRun& run) : run_(run) {}
    Status go_to(double /*time_s*/) override { return {}; }
    [[nodiscard]] const PosesAt& poses() const noexcept override { return run_.poses_; }
    [[nodiscard]] std::vector<ReadingAt> readings(std::span<const LookedAt> sensors,
                                                  bool parts) override {
      std::vector<ReadingAt> readings;
      for (const LookedAt& sensor : sensors) {
        const float range = sensor.slot % 2 == 0 ? kOpenRange_m : kSecretRange_m;
        const double stamp_s = run_.poses_.time_s;
        readings.push_back({sensor.slot, 0, 0, stamp_s, 1, 1, {range}});
        if (parts) readings.push_back({sensor.slot, 0, 1, stamp_s, 1, 1, {kHalfRange_m}});
      }
      return readings;
    }

   private:
    const FakeRun& run_;
  };
  class FakePlayhead final : public Playhead {
   public:
    explicit FakePlayhead(FakeRun& run) : run_(run) {}
    std::string take(const TransportMessage& /*transport*/, Clock::time_point /*now*/) override {
      ++run_.moved;
      return {};
    }
    PlayState look(Clock::time_point /*now*/) override {
      PlayState state;
      state.now_s = run_.poses_.time_s;
      state.picture = run_.poses_.serial;
      return state;
    }

   private:
    FakeRun& run_;
  };

  std::mutex mutex_;
  std::vector<PageComponent> next_components_;
  std::string components_error_;
  std::vector<ProbeRequest> requests_;
  std::vector<ChatText> kept_;
  std::vector<std::pair<CommandMessage, Author>> commands_;
  std::string robots_;
  std::string bodies_ =
      R"([{"id":0,"name":"secret-pond","kind":"virtual","pose":[4321.5,0,0],"shapes":[{"disc":[0,0,1],"z":[0,1]}]},)"
      R"({"id":1,"name":"hall","kind":"wall","pose":[2,3,0],)"
      R"("shapes":[{"polygon":[[-1,-0.1],[1,-0.1],[1,0.1],[-1,0.1]],"z":[0,2]}]}])";
  std::vector<LogEvent> events_;
  PosesAt poses_;
  MapBook maps_{"[]", "[]"};
};

}  // namespace rave::gui_server::testing
