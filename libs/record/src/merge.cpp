// SPDX-License-Identifier: Apache-2.0
// One recording from those of several processes. Each step takes from each part what that process
// knows best: a host its robots, the authority the world.
#include "rave/record/merge.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <tuple>

#include "merge_part.hpp"
#include "once.hpp"
#include "rave/base/hash.hpp"
#include "rave/record/robot_ranges.hpp"
#include "rave/record/run_record.hpp"
#include "rows.hpp"

namespace rave::record {
namespace {

namespace fs = std::filesystem;

/// Calls `take(part, item)` for each item of a topic at this time; messages that cannot be decoded
/// are skipped.
template <class Decode, class Take>
void each_item(const std::vector<std::unique_ptr<MergePart>>& parts, const char* topic,
               Decode decode, Take take) {
  for (const auto& part : parts) {
    if (!part->here) continue;
    for (const MomentCursor::Bytes& message : part->cursor.messages(topic)) {
      const auto decoded = decode(message);
      if (decoded) take(*part, *decoded);
    }
  }
}

/// A part whose beginning cannot be read.
struct Unreadable {
  fs::path path;
  std::string why;
};

class Merger {
 public:
  Merger(std::vector<std::unique_ptr<MergePart>> parts, std::vector<Unreadable> unreadable)
      : parts_(std::move(parts)), unreadable_(std::move(unreadable)) {}

  Result<std::vector<std::string>> write(const fs::path& output);

 private:
  [[nodiscard]] Status check() const;
  [[nodiscard]] RunInfo joined_info() const;
  [[nodiscard]] Status learn_hosts();
  [[nodiscard]] Status describe(RunRecorder& recorder);
  [[nodiscard]] bool next_moment();
  Status write_moment(RunRecorder& recorder);
  void write_poses(RunRecorder& recorder);
  void write_variances(RunRecorder& recorder);
  void write_hash(RunRecorder& recorder);
  void write_inputs(RunRecorder& recorder, bool before_first);
  void write_chat(RunRecorder& recorder);
  [[nodiscard]] bool was_told(const MergePart& part, const RunEvent& event);
  [[nodiscard]] std::vector<std::string> notes() const;

  /// Chat messages already written: number, from, to, name, text.
  std::set<std::tuple<std::uint64_t, std::string, std::string, std::string, std::string>> chats_;
  std::vector<std::unique_ptr<MergePart>> parts_;
  std::vector<Unreadable> unreadable_;
  std::vector<std::string> hosts_;                   ///< All hosts of the run.
  std::vector<const std::string*> owner_;            ///< By robot: its host's name, or null.
  std::vector<std::optional<RobotPose>> poses_;      ///< By robot, at the merged time.
  std::map<std::uint32_t, PoseVariance> variances_;  ///< By robot, the last ones.
  /// By change of an obstacle in real time: the first part that has it, and when.
  std::map<std::vector<double>, std::pair<const MergePart*, std::uint64_t>> told_;
  std::uint64_t time_ns_ = 0;
  bool hashed_ = true;  ///< Every step had all hashes.
};

Status Merger::check() const {
  const MergePart& first = *parts_.front();
  if (!(first.info.step_s >= 1e-9 && first.info.step_s < 1e9)) {
    return fail(ErrorCode::kParse, "`{}` does not state the step", first.path.string());
  }
  // The scenario, seed, step and robots identify a run; starting times differ between processes.
  for (const auto& part : parts_) {
    if (part->info.scenario == first.info.scenario && part->info.seed == first.info.seed &&
        part->info.step_s == first.info.step_s && part->info.robots == first.info.robots) {
      continue;
    }
    return fail(ErrorCode::kParse, "`{}` and `{}` are recordings of different runs",
                first.path.string(), part->path.string());
  }
  return {};
}

RunInfo Merger::joined_info() const {
  RunInfo info = parts_.front()->info;
  for (const auto& part : parts_) {
    info.started = std::min(info.started, part->info.started);
    info.versions.insert(part->info.versions.begin(), part->info.versions.end());
    info.inputs.insert(part->info.inputs.begin(), part->info.inputs.end());
    // What all have is there once.
    info.files.merge(read_attached_files(part->reader).files);
    if (&part == &parts_.front()) continue;
    info.sensors.insert(info.sensors.end(), part->info.sensors.begin(), part->info.sensors.end());
  }
  const auto place = [](const RecordedSensor& sensor) {
    return std::pair(sensor.robot, sensor.sensor);
  };
  std::ranges::stable_sort(info.sensors, {}, place);
  // A restarted host describes its sensors again.
  const auto again = std::ranges::unique(info.sensors, {}, place);
  info.sensors.erase(again.begin(), again.end());
  return info;
}

Status Merger::learn_hosts() {
  const auto count = static_cast<std::uint32_t>(parts_.front()->info.robots.size());
  owner_.assign(count, nullptr);
  poses_.resize(count);
  StringMap all;
  for (const auto& part : parts_) {
    const StringMap known = part->reader.metadata_named(kHostsMetadata);
    // Each process records which host has which robots, so one readable part is enough.
    all.insert(known.begin(), known.end());
  }
  for (const auto& [host, robots] : all) hosts_.push_back(host);
  for (const std::string& host : hosts_) {
    RAVE_TRY_ASSIGN(const auto robots, parse_robot_ranges(all[host], count));
    for (const std::uint32_t robot : robots) owner_[robot] = &host;
  }
  return {};
}

std::vector<std::string> Merger::notes() const {
  std::vector<std::string> notes;
  for (const Unreadable& part : unreadable_) notes.push_back(part.why);
  for (const auto& part : parts_) {
    if (part->torn.empty()) continue;
    notes.push_back(fmt::format("`{}` is incomplete: {}", part->path.string(), part->torn));
  }
  for (const std::string& host : hosts_) {
    const bool there =
        std::ranges::any_of(parts_, [&](const auto& part) { return part->host == host; });
    if (!there) notes.push_back(fmt::format("there is no recording of host `{}`", host));
  }
  return notes;
}

Status Merger::describe(RunRecorder& recorder) {
  StringMap hybrids;
  for (const auto& part : parts_) {
    const StringMap own = part->reader.metadata_named(kHybridMetadata);
    hybrids.insert(own.begin(), own.end());
  }
  if (!hybrids.empty()) RAVE_TRY(recorder.describe(kHybridMetadata, hybrids));
  return {};
}

// Messages of one step have the same log time in all parts. So the parts are read side by side, one
// moment after the other.
bool Merger::next_moment() {
  time_ns_ = std::numeric_limits<std::uint64_t>::max();
  for (const auto& part : parts_) {
    if (part->more) time_ns_ = std::min(time_ns_, part->cursor.time_ns());
  }
  bool any = false;
  for (const auto& part : parts_) {
    part->here = part->more && part->cursor.time_ns() == time_ns_;
    any = any || part->here;
  }
  return any;
}

void Merger::write_poses(RunRecorder& recorder) {
  std::ranges::fill(poses_, std::nullopt);
  each_item(parts_, topic::kPoses, decode_poses, [&](const MergePart& part, const auto& step) {
    for (const RobotPose& pose : step.items) {
      const std::uint32_t r = pose.robot.value();
      if (r >= poses_.size()) continue;
      // Several parts may have a pose of the same robot; that of its own host counts.
      const bool own = owner_[r] != nullptr && *owner_[r] == part.host;
      if (poses_[r] && !own) continue;
      poses_[r] = pose;
    }
  });
  for (const auto& pose : poses_) {
    if (pose) recorder.pose(*pose);
  }
}

/// A host writes about its own robots, each at its own pace. In the result each message has those
/// of all.
void Merger::write_variances(RunRecorder& recorder) {
  bool told = false;
  each_item(parts_, topic::kVariances, decode_variances,
            [&](const MergePart& part, const auto& step) {
              std::erase_if(variances_, [&](const auto& known) {
                const std::string* const owner = owner_[known.first];
                return owner != nullptr && *owner == part.host;
              });
              for (const PoseVariance& robot : step.items) {
                if (robot.robot.value() < owner_.size()) variances_[robot.robot.value()] = robot;
              }
              told = true;
            });
  if (!told) return;
  std::vector<PoseVariance> all;
  for (const auto& [robot, variance] : variances_) all.push_back(variance);
  static_cast<void>(recorder.variances(all));
}

void Merger::write_hash(RunRecorder& recorder) {
  RunHash sum;
  std::size_t known = 0;
  each_item(parts_, topic::kHash, decode_hash, [&](const MergePart&, const StepHash& step) {
    sum.merge(RunHash::of_value(step.hash));
    ++known;
  });
  // The hashes of all hosts and of the authority are needed.
  hashed_ = hashed_ && known == hosts_.size() + 1;
  if (hashed_) static_cast<void>(recorder.hash(sum.value()));
}

void Merger::write_inputs(RunRecorder& recorder, bool before_first) {
  Once<RunInput> once;
  each_item(parts_, topic::kInputs, decode_input,
            [&](const MergePart& part, const RunInput& input) {
              if ((input.step == 0) == before_first) once.add(&part, input);
            });
  for (const RunInput& input : once.items()) static_cast<void>(recorder.input(input));
}

/// Several hosts may have a chat message at different times: the first one is used.
void Merger::write_chat(RunRecorder& recorder) {
  each_item(parts_, topic::kChat, decode_chat, [&](const MergePart&, const auto& said) {
    const RunChat& chat = said.second;
    if (!chats_.emplace(chat.number, chat.from, chat.to, chat.name, chat.text).second) return;
    static_cast<void>(recorder.chat(chat));
  });
}

/// In real time each host records an obstacle change when it arrives: the first one is used. The
/// event identifies the obstacle and the change.
bool Merger::was_told(const MergePart& part, const RunEvent& event) {
  const bool counted =
      !event.robot.valid() && event.kind.starts_with("obstacle ") && event.values.size() == 2 &&
      std::ranges::all_of(event.values, [](double value) { return std::isfinite(value); });
  if (!counted) return false;
  const std::pair<const MergePart*, std::uint64_t> now(&part, time_ns_);
  return told_.try_emplace(event.values, now).first->second != now;
}

Status Merger::write_moment(RunRecorder& recorder) {
  const std::int64_t step_ns = from_seconds(parts_.front()->info.step_s).ns;
  // Log times are those of steps, so the number of the step follows.
  const auto step = time_ns_ / static_cast<std::uint64_t>(step_ns);
  write_inputs(recorder, true);
  recorder.begin_step(step, SimTime{static_cast<std::int64_t>(time_ns_)});
  each_item(parts_, topic::kPercepts, decode_percepts,
            [&](const MergePart&, const auto& all) { add_rows(all.items, recorder); });
  each_item(parts_, topic::kCommands, decode_commands,
            [&](const MergePart&, const auto& all) { add_rows(all.items, recorder); });
  each_item(parts_, topic::kActuators, decode_actuators, [&](const MergePart&, const auto& all) {
    for (const ActuatorRecord& command : all.items) recorder.actuator(command);
  });
  each_item(parts_, topic::kRadio, decode_radio, [&](const MergePart&, const auto& all) {
    for (const RadioPacket& packet : all.items) recorder.radio(packet);
  });
  Once<RunEvent> events;
  const bool authority =
      std::ranges::any_of(parts_, [](const auto& part) { return part->host.empty(); });
  each_item(parts_, topic::kEvents, decode_event, [&](const MergePart& part, const auto& all) {
    for (const RunEvent& event : all.items) {
      // For events of the world the authority's recording takes precedence.
      const bool of_world = !event.robot.valid();
      if (of_world && authority && !part.host.empty()) continue;
      if (!was_told(part, event)) events.add(&part, event);
    }
  });
  std::ranges::stable_sort(events.items(), {}, &RunEvent::robot);
  for (const RunEvent& event : events.items()) RAVE_TRY(recorder.event(event));
  write_poses(recorder);
  write_variances(recorder);
  write_hash(recorder);
  Once<ConsoleLine> lines;
  each_item(parts_, topic::kConsole, decode_console,
            [&](const MergePart& part, const ConsoleLine& line) { lines.add(&part, line); });
  for (const ConsoleLine& line : lines.items()) {
    recorder.console(line.level, line.source, line.text);
  }
  RAVE_TRY(recorder.end_step());
  write_inputs(recorder, false);
  write_chat(recorder);
  return {};
}

Result<std::vector<std::string>> Merger::write(const fs::path& output) {
  RAVE_TRY(check());
  RAVE_TRY(learn_hosts());
  RAVE_TRY_ASSIGN(auto recorder, RunRecorder::open(output, joined_info()));
  RAVE_TRY(describe(recorder));
  for (const auto& part : parts_) part->advance();
  while (next_moment()) {
    RAVE_TRY(write_moment(recorder));
    for (const auto& part : parts_) {
      if (part->here) part->advance();
    }
  }
  std::vector<std::string> found = notes();
  StringMap kept;
  for (const std::string& note : found) kept[fmt::format("note {:04}", kept.size())] = note;
  const auto keep_size = [&](const fs::path& path, std::uint64_t bytes) {
    kept["file " + path.lexically_proximate(output.parent_path()).generic_string()] =
        std::to_string(bytes);
  };
  for (const auto& part : parts_) keep_size(part->path, part->reader.file_size());
  for (const Unreadable& part : unreadable_) {
    std::error_code error;
    keep_size(part.path, fs::file_size(part.path, error));
  }
  RAVE_TRY(recorder.describe(kPartsMetadata, kept));
  // Without an end the merged recording shows that the run is incomplete.
  if (!found.empty()) return found;
  RunHash sum;
  bool hashed = hashed_;
  for (const auto& part : parts_) {
    hashed = hashed && part->end && part->end->hash;
    if (hashed) sum.merge(RunHash::of_value(*part->end->hash));
  }
  RAVE_TRY(recorder.end(hashed ? std::optional(sum.value()) : std::nullopt));
  return found;
}

}  // namespace

Result<std::vector<std::string>> merge_records(const std::vector<fs::path>& parts,
                                               const fs::path& output) {
  std::vector<std::unique_ptr<MergePart>> opened;
  std::vector<Unreadable> unreadable;
  for (const fs::path& path : parts) {
    auto part = open_part(path);
    if (part) {
      opened.push_back(*std::move(part));
    } else {
      unreadable.push_back({path, part.error().text()});
    }
  }
  if (opened.empty()) {
    return fail(ErrorCode::kParse, "no recording of the run can be read{}{}",
                unreadable.empty() ? "" : ": ", unreadable.empty() ? "" : unreadable.front().why);
  }
  // Renamed when it is complete: who opens the run meanwhile finds no half recording.
  fs::path draft = output;
  draft += ".merging";
  auto notes = Merger(std::move(opened), std::move(unreadable)).write(draft);
  std::error_code error;
  if (!notes) {
    fs::remove(draft, error);
    return notes;
  }
  fs::rename(draft, output, error);
  if (!error) return notes;
  return fail(ErrorCode::kIo, "cannot write `{}`: {}", output.string(), error.message());
}

}  // namespace rave::record
