// SPDX-License-Identifier: Apache-2.0
// Records a run. Within a step, data are gathered by stream; end_step() writes one message per
// stream, whatever the number of robots.
#include "rave/record/run_record.hpp"

#include <mutex>
#include <vector>

#include "encode.hpp"
#include "packed.hpp"
#include "pose_batch.hpp"
#include "standard_views.hpp"

namespace rave::record {
namespace {

/// The data of one stream in a step: packed elements and the bytes that they refer to. The copied
/// bytes come first, then blocks, which stay in place until the message is written.
template <class Packed>
struct Batch {
  Stream stream;
  std::vector<Packed> elements;
  std::vector<std::byte> records;
  std::vector<std::size_t> block_elements;  ///< Elements that blocks belong to.
  std::vector<std::span<const std::byte>> blocks;
  std::vector<std::span<const std::byte>> parts;  ///< Parts of the message while it is written.

  void add(Packed element, std::span<const std::byte> bytes) {
    element.offset = static_cast<std::uint32_t>(records.size());
    element.size = static_cast<std::uint32_t>(bytes.size());
    elements.push_back(element);
    records.insert(records.end(), bytes.begin(), bytes.end());
  }
  void add_block(Packed element, std::span<const std::byte> bytes) {
    element.size = static_cast<std::uint32_t>(bytes.size());
    block_elements.push_back(elements.size());
    elements.push_back(element);
    blocks.push_back(bytes);
  }
  /// Writes one message directly into the file's buffer; nothing if there are no elements.
  Status write(McapWriter& file, CdrWriter& cdr, SimTime time, std::uint64_t step) {
    if (elements.empty()) return {};
    auto size = static_cast<std::uint32_t>(records.size());
    // Blocks come behind the copied bytes, so their offsets are known only now.
    for (const std::size_t element : block_elements) {
      elements[element].offset = size;
      size += elements[element].size;
    }
    encode_step_head(cdr, time, step, elements.size());
    // The parts are not put together first: the writer copies each into its chunk.
    parts.assign({cdr.bytes(), std::as_bytes(std::span(elements)),
                  std::as_bytes(std::span(&size, 1)), std::span<const std::byte>(records)});
    parts.insert(parts.end(), blocks.begin(), blocks.end());
    Status status = stream.write(file, time, parts);
    elements.clear();
    records.clear();
    block_elements.clear();
    blocks.clear();
    return status;
  }
};

}  // namespace

class RunRecorder::Impl {
 public:
  explicit Impl(McapWriter file) : file_(std::move(file)) {}

  [[nodiscard]] Status begin(const RunInfo& info, const ViewOptions& views);
  [[nodiscard]] Status write_console();
  /// Writes one message with the time of the step.
  template <class... T>
  Status write(Stream& stream, const T&... values) {
    encode(cdr_, time_, values...);
    return stream.write(file_, time_, cdr_.bytes());
  }
  /// Makes a stream that most runs do not need with its first message.
  template <class... T>
  Status write(std::optional<Stream>& stream, const char* topic, const RosSchema& schema,
               const T&... values) {
    if (!stream) {
      RAVE_TRY_ASSIGN(const auto id, add_schema(file_, schema));
      RAVE_TRY_ASSIGN(stream, add_stream(file_, topic, id));
    }
    return write(*stream, values...);
  }
  [[nodiscard]] Status write_pose_view() {
    if (seen_.empty()) return {};
    Status status = views_.poses(file_, time_, seen_);
    seen_.clear();
    return status;
  }

 private:
  friend class RunRecorder;

  McapWriter file_;
  StandardViews views_;
  Stream run_, end_, events_, inputs_, console_, hash_;
  std::optional<Stream> shadows_;
  std::optional<Stream> variances_;
  std::optional<Stream> chat_;
  PoseBatch poses_;
  std::vector<RobotPose> seen_;  ///< For the pose view, in steps in which it is due.
  bool view_due_ = false;
  Batch<PackedPercept> percepts_;
  Batch<PackedCommand> commands_;
  Batch<PackedActuator> actuators_;
  Batch<PackedPacket> radio_;
  CdrWriter cdr_;
  SimTime time_;
  std::uint64_t step_ = 0;
  std::uint64_t steps_ = 0;
  std::mutex console_mutex_;
  std::vector<ConsoleLine> console_lines_;  ///< Guarded by console_mutex_.
};

Status RunRecorder::Impl::begin(const RunInfo& info, const ViewOptions& views) {
  const auto add = [this](Stream& stream, const char* topic, const RosSchema& schema) -> Status {
    RAVE_TRY_ASSIGN(const auto id, add_schema(file_, schema));
    RAVE_TRY_ASSIGN(stream, add_stream(file_, topic, id));
    return {};
  };
  RAVE_TRY(add(run_, topic::kRun, kRunSchema));
  RAVE_TRY(add(end_, topic::kEnd, kEndSchema));
  RAVE_TRY(add(poses_.stream, topic::kPoses, kPosesSchema));
  RAVE_TRY(add(percepts_.stream, topic::kPercepts, kPerceptsSchema));
  RAVE_TRY(add(commands_.stream, topic::kCommands, kCommandsSchema));
  RAVE_TRY(add(actuators_.stream, topic::kActuators, kActuatorsSchema));
  RAVE_TRY(add(hash_, topic::kHash, kHashSchema));
  RAVE_TRY(add(radio_.stream, topic::kRadio, kRadioSchema));
  RAVE_TRY(add(events_, topic::kEvents, kEventSchema));
  RAVE_TRY(add(inputs_, topic::kInputs, kInputSchema));
  RAVE_TRY(add(console_, topic::kConsole, kLogSchema));
  RAVE_TRY(views_.open(file_, info, views));
  const std::string_view yaml = info.expanded_scenario;
  // With the expanded scenario and its maps a recording can be shown on any machine.
  RAVE_TRY(file_.add_attachment("scenario.yaml", "application/yaml",
                                std::as_bytes(std::span(yaml.data(), yaml.size()))));
  RAVE_TRY(attach_files(info.files, file_));
  StringMap about = {{"scenario", info.scenario},
                     {"started", info.started},
                     {"seed", std::to_string(info.seed)},
                     {"step_s", fmt::format("{}", info.step_s)},
                     {"robots", std::to_string(info.robots.size())}};
  for (const auto& [name, version] : info.versions) about["version " + name] = version;
  RAVE_TRY(file_.add_metadata("rave.run", about));
  if (!info.inputs.empty()) RAVE_TRY(file_.add_metadata("rave.inputs", info.inputs));
  cdr_.clear();
  CdrPut<RunMembers>{cdr_}(info);
  return run_.write(file_, SimTime{}, cdr_.bytes());
}

Status RunRecorder::Impl::write_console() {
  std::vector<ConsoleLine> lines;
  {
    const std::lock_guard lock(console_mutex_);
    if (console_lines_.empty()) return {};
    // Log lines come from any thread and get the time of the step that is being written.
    lines.swap(console_lines_);
  }
  Status status;
  for (const ConsoleLine& line : lines) {
    // Levels of rcl_interfaces/msg/Log: 10 debug, 20 info, 30 warning, 40 error; file, function and
    // line are unknown.
    const auto level = static_cast<std::uint8_t>(10 + 10 * static_cast<int>(line.level));
    const std::string none;
    auto written = write(console_, level, line.source, line.text, none, none, std::uint32_t{0});
    if (!written) status = written;
  }
  return status;
}

RunRecorder::RunRecorder(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
RunRecorder::RunRecorder(RunRecorder&&) noexcept = default;
RunRecorder& RunRecorder::operator=(RunRecorder&&) noexcept = default;
RunRecorder::~RunRecorder() = default;

Result<RunRecorder> RunRecorder::open(const std::filesystem::path& path, const RunInfo& info,
                                      const RunRecorderOptions& options, LogSink* sink) {
  RAVE_TRY_ASSIGN(auto file, McapWriter::open(path, options.file, sink));
  auto impl = std::make_unique<Impl>(std::move(file));
  RAVE_TRY(impl->begin(info, options.views));
  return RunRecorder(std::move(impl));
}

Status RunRecorder::describe(std::string_view name, const StringMap& entries) {
  return impl_->file_.add_metadata(name, entries);
}

void RunRecorder::begin_step(std::uint64_t step, SimTime time) {
  impl_->step_ = step;
  impl_->time_ = time;
  ++impl_->steps_;
  impl_->view_due_ = impl_->views_.poses_due(time);
}

void RunRecorder::percept(const Percept& percept) {
  const ReadingHeader& header = percept.header;
  impl_->percepts_.add({percept.robot.value(), static_cast<std::uint16_t>(percept.sensor.value()),
                        percept.kind, static_cast<std::uint8_t>(percept.part), header.stamp_ns,
                        header.sequence, header.count, header.fresh, header.dropped, 0, 0, 1, 0},
                       percept.records);
  // Standard messages exist for ranges; other sensors are in the packed stream only.
  if (percept.kind == kRangesKind && percept.part == PerceptPart::kResult &&
      impl_->views_.sees(percept.robot)) {
    // end_step() reports a failed write.
    static_cast<void>(impl_->views_.percept(impl_->file_, impl_->time_, percept));
  }
}

void RunRecorder::percepts(const PerceptBlock& block) {
  const ReadingHeader& header = block.header;
  impl_->percepts_.add_block(
      {block.first.value(), static_cast<std::uint16_t>(block.sensor.value()), block.kind,
       static_cast<std::uint8_t>(PerceptPart::kResult), header.stamp_ns, header.sequence,
       header.count, header.fresh, header.dropped, 0, 0, block.robots, 0},
      block.records);
  if (block.kind != kRangesKind || !impl_->views_.sees(block.first)) return;
  const std::size_t size = block.records.size() / block.robots;
  for (std::uint32_t i = 0; i < block.robots; ++i) {
    const RobotId robot(block.first.value() + i);
    if (!impl_->views_.sees(robot)) return;
    // end_step() reports a failed write.
    static_cast<void>(impl_->views_.percept(impl_->file_, impl_->time_,
                                            {robot, block.sensor, block.kind, PerceptPart::kResult,
                                             header, block.records.subspan(i * size, size)}));
  }
}

void RunRecorder::command(const CommandRecord& command) {
  impl_->commands_.add({command.robot.value(), command.controller.value(), 0, 0, 1, 0},
                       command.command);
  if (impl_->views_.sees(command.robot)) {
    static_cast<void>(impl_->views_.command(impl_->file_, impl_->time_, command));
  }
}

void RunRecorder::commands(const CommandBlock& block) {
  impl_->commands_.add_block({block.first.value(), block.controller.value(), 0, 0, block.robots, 0},
                             block.commands);
  const std::size_t size = block.commands.size() / block.robots;
  for (std::uint32_t i = 0; i < block.robots; ++i) {
    const RobotId robot(block.first.value() + i);
    if (!impl_->views_.sees(robot)) return;
    static_cast<void>(
        impl_->views_.command(impl_->file_, impl_->time_,
                              {robot, block.controller, block.commands.subspan(i * size, size)}));
  }
}

void RunRecorder::actuator(const ActuatorRecord& command) {
  impl_->actuators_.add({command.robot.value(), command.actuator.value(), 0, 0}, command.command);
}

Status RunRecorder::hash(std::uint64_t value) {
  return impl_->write(impl_->hash_, impl_->step_, value);
}

void RunRecorder::radio(const RadioPacket& packet) {
  impl_->radio_.add(
      {packet.sent_ns, packet.received_ns, packet.from.value(), packet.to.value(),
       packet.transmitter, static_cast<std::uint16_t>(packet.delivered ? 1 : 0), 0, 0, 0},
      packet.payload);
}

Status RunRecorder::event(const RunEvent& event) {
  return impl_->write(impl_->events_, impl_->step_, event);
}

Status RunRecorder::input(const RunInput& input) { return impl_->write(impl_->inputs_, input); }

Status RunRecorder::chat(const RunChat& chat) {
  return impl_->write(impl_->chat_, topic::kChat, kChatSchema, chat);
}

Status RunRecorder::shadow(const ShadowRecord& shadow) {
  return impl_->write(impl_->shadows_, topic::kShadows, kShadowSchema, impl_->step_, shadow);
}

Status RunRecorder::variances(std::span<const PoseVariance> robots) {
  return impl_->write(impl_->variances_, topic::kVariances, kVariancesSchema, impl_->step_,
                      kLayoutVersion, std::vector(robots.begin(), robots.end()));
}

void RunRecorder::pose(const RobotPose& robot) {
  impl_->poses_.add(robot);
  if (impl_->view_due_) impl_->seen_.push_back(robot);
}

void RunRecorder::poses(const PoseBlock& block) {
  impl_->poses_.add(block);
  if (!impl_->view_due_) return;
  for (std::uint32_t i = 0; i < block.robots; ++i) {
    const Pose2& X_WR = PoseBatch::at(block.X_WR, block.stride_bytes, i);
    impl_->seen_.push_back({RobotId(block.first.value() + i), X_WR, X_WR, {}});
  }
}

Status RunRecorder::end_step() {
  Impl& impl = *impl_;
  // All batches must be emptied, even if one of them fails.
  const Status results[] = {impl.poses_.write(impl.file_, impl.cdr_, impl.time_, impl.step_),
                            impl.write_pose_view(),
                            impl.percepts_.write(impl.file_, impl.cdr_, impl.time_, impl.step_),
                            impl.commands_.write(impl.file_, impl.cdr_, impl.time_, impl.step_),
                            impl.actuators_.write(impl.file_, impl.cdr_, impl.time_, impl.step_),
                            impl.radio_.write(impl.file_, impl.cdr_, impl.time_, impl.step_),
                            impl.write_console()};
  for (const Status& result : results) RAVE_TRY(result);
  return {};
}

void RunRecorder::console(LogLevel level, std::string_view source, std::string_view text) {
  const std::lock_guard lock(impl_->console_mutex_);
  impl_->console_lines_.push_back({SimTime{}, level, std::string(source), std::string(text)});
}

Status RunRecorder::flush() { return impl_->file_.flush(); }

Status RunRecorder::end(std::optional<std::uint64_t> hash) {
  Impl& impl = *impl_;
  Status written = end_step();
  // The end is a message and metadata: the message for readers in order, the metadata for tools
  // that read the summary only.
  if (written) {
    written = impl.write(impl.end_, impl.steps_, hash.has_value(), hash.value_or(0));
  }
  StringMap about = {{"steps", std::to_string(impl.steps_)}};
  if (hash) about["hash"] = fmt::format("{:016x}", *hash);
  if (written) written = impl.file_.add_metadata("rave.end", about);
  Status closed = impl.file_.close();
  RAVE_TRY(written);
  return closed;
}

const McapWriter& RunRecorder::file() const noexcept { return impl_->file_; }

}  // namespace rave::record
