// SPDX-License-Identifier: Apache-2.0
#include "program_host.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "crash_report.hpp"
#include "message.hpp"

namespace rave::isolation {

Result<std::unique_ptr<ProgramHost>> ProgramHost::create(SharedMemory memory, int socket) {
  const auto* head = memory.at<SharedHead>(0);
  // The runner may be of another installation than the host. A wrong layout must not be taken for
  // data.
  if (memory.size() < sizeof(SharedHead) || head->magic != SharedHead::kMagic ||
      head->total_bytes != memory.size() || head->setup_bytes > memory.size()) {
    return fail(ErrorCode::kParse, "the shared memory was created by another version of the host");
  }
  // The offset of the setup does not depend on the parts after it.
  const std::size_t at = make_layout(head->setup_bytes, {}, {}, 0).setup;
  RAVE_TRY_ASSIGN(auto setup, SetupCopy::decode({memory.at<char>(at), head->setup_bytes}));
  std::unique_ptr<ProgramHost> host(new ProgramHost(std::move(memory), std::move(setup), socket));
  if (host->layout_.total_bytes != host->memory_.size()) {
    return fail(ErrorCode::kParse, "the shared memory has {} bytes, but its setup needs {}",
                host->memory_.size(), host->layout_.total_bytes);
  }
  return host;
}

ProgramHost::ProgramHost(SharedMemory memory, std::unique_ptr<SetupCopy> setup, int socket)
    : socket_(socket), memory_(std::move(memory)), setup_(std::move(setup)), log_(socket) {
  setup_->set_host(log_.services());
  const ProgramSetup& raw = setup_->setup();
  layout_ =
      make_layout(memory_.at<SharedHead>(0)->setup_bytes, std::span(raw.sensors, raw.sensor_count),
                  std::span(raw.communicators, raw.communicator_count), raw.controller_count);
  // create() refuses this memory; the views below would reach beyond it.
  if (layout_.total_bytes != memory_.size()) return;
  for (const Layout::Sensor& sensor : layout_.sensors) {
    views_.push_back(
        {memory_.at<SampleHeader>(sensor.header), memory_.at<std::byte>(sensor.records)});
  }
  answers_ = std::make_unique<AnswerWriter>(
      memory_.at<SharedAnswers>(layout_.answers),
      memory_.at<std::byte>(layout_.answers + sizeof(SharedAnswers)));
  boxes_.resize(2 * layout_.communicators.size());
  for (std::size_t c = 0; c < layout_.communicators.size(); ++c) {
    boxes_[2 * c] = mailbox(layout_.communicators[c].in);
    boxes_[2 * c + 1] = mailbox(layout_.communicators[c].out);
    communicators_.push_back({&boxes_[2 * c], &boxes_[2 * c + 1]});
  }
}

Mailbox ProgramHost::mailbox(const Layout::Box& box) const {
  const auto& counts = *memory_.at<SharedMailbox>(box.state);
  return {memory_.at<rave::MessageHead>(box.heads),
          memory_.at<std::byte>(box.data),
          box.max_messages,
          box.max_bytes,
          counts.count,
          counts.bytes,
          counts.dropped,
          0};
}

ProgramHost::~ProgramHost() {
  if (constructed_) file_->ops().instance.destroy(instance_.get());
}

Status ProgramHost::load_and_start() {
  RAVE_TRY_ASSIGN(file_, ProgramFile::load(order().plugin, order().program));
  const ProgramOps& ops = file_->ops();
  // Before the first call into the plug-in that may crash.
  learn_plugin(reinterpret_cast<const void*>(ops.decide));
  const std::align_val_t alignment{ops.instance.alignment};
  // Types of plug-ins may need a larger alignment than malloc() gives.
  instance_ = {::operator new(ops.instance.size, alignment), FreeAligned{alignment}};
  ErrorText error;
  constructed_ = ops.instance.construct(instance_.get(), &error) == 0;
  if (!constructed_ || ops.start(instance_.get(), &setup_->setup(), &error) != 0) {
    return fail(ErrorCode::kPlugin, "{}", error.text);
  }
  return {};
}

Status ProgramHost::start() {
  Status status = load_and_start();
  const std::uint32_t dropped = log_.begin_next();
  if (status) {
    send_message(socket_, {MessageKind::kStarted, 0, dropped}, {}, true);
  } else {
    const auto code = static_cast<std::uint32_t>(status.error().code);
    send_message(socket_, {MessageKind::kStartFailed, code, dropped}, status.error().text(), true);
  }
  return status;
}

void ProgramHost::serve() {
  std::vector<char> buffer(kMaxMessageBytes);
  for (;;) {
    const ssize_t size = ::recv(socket_, buffer.data(), buffer.size(), 0);
    if (size < 0 && errno == EINTR) continue;
    MessageHead head;
    // 0: the host has closed the socket, which is how it asks the child to end.
    if (size < static_cast<ssize_t>(sizeof head)) return;
    std::memcpy(&head, buffer.data(), sizeof head);
    const std::string_view text(buffer.data() + sizeof head,
                                static_cast<std::size_t>(size) - sizeof head);
    if (head.kind == MessageKind::kUpdate) {
      if (!update(text)) return;
      continue;
    }
    if (head.kind != MessageKind::kDecide || !text.empty() || !decide(head.number)) return;
  }
}

bool ProgramHost::update(std::string_view bytes) {
  if (!setup_->update(bytes)) return false;
  const ProgramSetup& setup = setup_->setup();
  const ProgramOps& ops = file_->ops();
  ErrorText error;
  error.set(kTakesNoParameters);
  const bool taken = ops.update != nullptr &&
                     ops.update(instance_.get(), setup.params, setup.param_count, &error) == 0;
  // The program keeps its old parameters, so this copy must hold them, too.
  if (!taken) setup_->revert();
  const auto kind = taken ? MessageKind::kUpdated : MessageKind::kUpdateRefused;
  return send_message(socket_, {kind, 0, log_.begin_next()}, taken ? "" : error.text, true);
}

bool ProgramHost::decide(std::uint32_t decision) {
  const auto& shared = *memory_.at<SharedDecide>(layout_.decide);
  DecideItem item;
  item.sensors = views_.data();
  item.commands = memory_.at<Command>(layout_.commands);
  for (std::size_t c = 0; c < layout_.communicators.size(); ++c) {
    boxes_[2 * c] = mailbox(layout_.communicators[c].in);
    // The outbox is new for each decision; what the program does not send in it is gone.
    boxes_[2 * c + 1].clear();
  }
  item.communicators = communicators_.data();
  item.now_ns = shared.now_ns;
  item.pose = shared.pose;
  item.decision = shared.decision;
  item.robot = shared.robot;
  item.seed = shared.seed;
  const SharedOrders asked = *memory_.at<SharedOrders>(layout_.orders);
  read_orders(asked, memory_.at<std::byte>(layout_.orders + sizeof asked), orders_);
  item.orders = orders_.data();
  item.order_count = static_cast<std::uint32_t>(orders_.size());
  item.driven = asked.driven;
  item.state = memory_.at<std::uint64_t>(layout_.state);
  answers_->begin();
  if (asked.listens != 0) item.answers = answers_->service();
  const ProgramOps& ops = file_->ops();
  std::uint8_t failed = 0;
  ErrorText error;
  // A batch of one: the interface takes many robots per call, and a child has one.
  ops.decide(instance_.get(), ops.instance.size, &item, 1, &failed, &error);
  for (std::size_t c = 0; c < layout_.communicators.size(); ++c) {
    const Mailbox& out = boxes_[2 * c + 1];
    *memory_.at<SharedMailbox>(layout_.communicators[c].out.state) = {out.count, out.bytes,
                                                                      out.dropped, 0};
  }
  const auto kind = failed != 0 ? MessageKind::kDecideFailed : MessageKind::kDecided;
  return send_message(socket_, {kind, decision, log_.begin_next()}, failed != 0 ? error.text : "",
                      true) &&
         failed == 0;
}

}  // namespace rave::isolation
