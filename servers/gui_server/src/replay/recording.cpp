// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "rave/gui_server/source.hpp"
#include "rave/record/run_reader.hpp"
#include "rave/recording/recorded_scenario.hpp"
#include "replay/recording_cursor.hpp"
#include "replay/replay_playhead.hpp"
#include "rights/scenario_rights.hpp"
#include "run/components.hpp"
#include "run/event_fold.hpp"
#include "run/map_book.hpp"
#include "run/scene_json.hpp"

namespace rave::gui_server {
namespace {

constexpr const char* kNoStop = "A recording cannot be stopped.";
constexpr const char* kNoOrders = "This is a recording: it takes no orders.";

class Recording final : public Source {
 public:
  explicit Recording(record::McapReader reader) : reader_(std::move(reader)) {}

  Status read(const std::filesystem::path& file);

  [[nodiscard]] const RunAbout& about() const noexcept override { return about_; }
  [[nodiscard]] const std::string& bodies_json() const noexcept override { return bodies_; }
  [[nodiscard]] const std::string& robots_json() const noexcept override { return robots_; }
  [[nodiscard]] std::uint32_t robot_count() const noexcept override {
    return static_cast<std::uint32_t>(real_.size());
  }
  [[nodiscard]] std::span<const LogEvent> events() const noexcept override { return events_; }
  [[nodiscard]] std::unique_ptr<Cursor> open_cursor() override {
    return std::make_unique<RecordingCursor>(reader_, flags_, real_, history_, about_.step_s,
                                             longest_period_s_);
  }
  [[nodiscard]] std::unique_ptr<Playhead> open_playhead() override {
    return std::make_unique<ReplayPlayhead>(about_, Playhead::Clock::now());
  }
  [[nodiscard]] Powers powers() const override {
    Powers powers{
        {"play", "seek", "pace", "step", "readings", "hybrid_parts", "obstacles", "log",
         "recording", "chat", "maps"},
        {{"stop", kNoStop}, {"release", kNoStop}, {"command", kNoOrders}, {"edit", kNoOrders}}};
    // The true poses of real robots are unknown.
    if (std::ranges::find(real_, 0) != real_.end()) {
      powers.may.emplace_back("true_pose");
    } else {
      powers.why_not["true_pose"] = "This recording has no simulated robot, so no true poses.";
    }
    return powers;
  }
  [[nodiscard]] std::span<const ChatText> chat() const noexcept override { return chat_; }
  // Maps that robots made are not recorded; the one of the world file is known all the same.
  [[nodiscard]] std::vector<MapName> map_names() const override { return maps_->names(); }
  [[nodiscard]] std::uint64_t map_names_revision() const noexcept override { return 1; }
  [[nodiscard]] std::uint64_t maps_revision() const noexcept override { return 1; }
  [[nodiscard]] const MapShown* map(const MapName& name) const override {
    return maps_->find(name);
  }
  void halt(const HaltMessage& /*halt*/, const Author& /*author*/, Reply reply) override {
    reply(false, kNoStop);
  }

 private:
  Status read_events(const record::RunInfo& run);
  Status read_chat();
  void note_flag(const record::RunEvent& event, double t_s);

  record::McapReader reader_;
  RunAbout about_;
  std::string bodies_;
  std::string robots_;
  std::vector<LogEvent> events_;
  std::vector<ChatText> chat_;
  std::vector<std::uint8_t> real_;
  FlagHistory flags_;
  BodyHistory history_;
  std::optional<MapBook> maps_;
  double longest_period_s_ = 0;
};

Status Recording::read(const std::filesystem::path& file) {
  RAVE_TRY_ASSIGN(const record::RunInfo run, record::read_run_info(reader_));
  RAVE_TRY_ASSIGN(const runtime::RecordedScenario recorded,
                  runtime::recorded_scenario(reader_, run, file));
  const config::ExpandedScenario& scenario = recorded.scenario;
  about_.notes = recorded.notes;
  // Slots index both lists. A file in which they differ was not written by one run.
  if (scenario.robots.size() != run.robots.size()) {
    return fail(ErrorCode::kParse, "`{}`: its scenario has {} robots, its recording {}",
                file.string(), scenario.robots.size(), run.robots.size());
  }
  about_.name = run.scenario;
  about_.started = run.started;
  about_.step_s = run.step_s;
  about_.seed = run.seed;
  about_.rights = rights_of(scenario.scenario.gui);
  about_.components = components_left(scenario.scenario.gui);
  about_.recording = file;
  about_.recording_bytes = reader_.file_size();
  about_.begin_s = static_cast<double>(reader_.statistics().start_ns) * 1e-9;
  about_.end_s = static_cast<double>(reader_.statistics().end_ns) * 1e-9;
  // What was planned does not matter for a replay: its timeline ends where the recording ends.
  about_.duration_s = about_.end_s;
  // Missing in a recording that broke off, which can be shown all the same.
  if (const auto end = record::read_run_end(reader_)) {
    about_.recording_whole = reader_.whole();
    about_.lock_step = end->hash.has_value();
    if (end->hash) about_.hash = fmt::format("{:016x}", *end->hash);
  }
  for (const record::RecordedRobot& robot : run.robots) {
    real_.push_back(robot.kind == "simulated" ? 0 : 1);
  }
  for (const record::RecordedSensor& sensor : run.sensors) {
    // A cursor that jumps must look back this far to find the last sample of each sensor.
    longest_period_s_ = std::max(longest_period_s_, sensor.period_s);
  }
  RAVE_TRY_ASSIGN(bodies_, bodies_of(scenario));
  RAVE_TRY(history_.read(reader_, scenario, bodies_));
  robots_ = robots_of(scenario, run, reader_.metadata_named(record::kHybridMetadata));
  // Without robots: their local maps are not in a recording.
  maps_.emplace("[]", bodies_);
  RAVE_TRY(read_chat());
  return read_events(run);
}

Status Recording::read_chat() {
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(auto said, record::decode_chat(message.bytes));
    auto& [time, chat] = said;
    chat_.push_back({chat.number, time.seconds(), std::move(chat.from), std::move(chat.role),
                     std::move(chat.to), std::move(chat.name), std::move(chat.text)});
    return {};
  };
  return record::for_each_message(reader_, record::topic::kChat, take);
}

Status Recording::read_events(const record::RunInfo& run) {
  std::vector<std::string> names;
  for (const record::RecordedRobot& robot : run.robots) names.push_back(robot.name);
  EventFold fold(std::move(names));
  flags_.resize(run.robots.size());
  const auto take = [&](const record::MessageView& message) -> Status {
    RAVE_TRY_ASSIGN(const auto step, record::decode_event(message.bytes));
    for (const record::RunEvent& event : step.items) {
      const int slot = event.robot.valid() ? static_cast<int>(event.robot.value()) : -1;
      fold.add(step.time.seconds(), slot, event.kind, event.text);
      note_flag(event, step.time.seconds());
    }
    return {};
  };
  RAVE_TRY(record::for_each_message(reader_, record::topic::kEvents, take));
  events_ = fold.events();
  for (auto& changes : flags_) {
    // The end of a touch was noted with its begin, so the changes are out of order.
    std::stable_sort(changes.begin(), changes.end(),
                     [](const FlagChange& a, const FlagChange& b) { return a.t_s < b.t_s; });
  }
  return {};
}

void Recording::note_flag(const record::RunEvent& event, double t_s) {
  if (!event.robot.valid() || event.robot.value() >= flags_.size()) return;
  auto& changes = flags_[event.robot.value()];
  if (event.kind == "pose stale") changes.push_back({t_s, kStale, true});
  if (event.kind == "pose back") changes.push_back({t_s, kStale, false});
  if (event.kind == "stopped") changes.push_back({t_s, kStopped, true});
  if (event.kind == "released") changes.push_back({t_s, kStopped, false});
  if (event.kind == "contact") {
    changes.push_back({t_s, kTouching, true});
    // The recording has the begin of a contact and not its end.
    changes.push_back({t_s + kTouch_s, kTouching, false});
  }
}

}  // namespace

Result<std::shared_ptr<Source>> open_recording(const std::filesystem::path& file) {
  RAVE_TRY_ASSIGN(record::McapReader reader, record::McapReader::open(file));
  auto recording = std::make_shared<Recording>(std::move(reader));
  RAVE_TRY(recording->read(file));
  return std::shared_ptr<Source>(std::move(recording));
}

}  // namespace rave::gui_server
