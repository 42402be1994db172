// SPDX-License-Identifier: Apache-2.0
#include "rave/isolation/isolated_program.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <utility>

#include "deadline.hpp"
#include "describe.hpp"
#include "layout.hpp"
#include "link.hpp"
#include "order_bytes.hpp"
#include "setup_copy.hpp"
#include "shared_memory.hpp"

namespace rave::isolation {

struct IsolatedProgram::Impl {
  Impl(const IsolationOptions& options, std::string who, const HostServices& host,
       SharedMemory shared, Layout where, ChildProcess child, Descriptor socket)
      : timeout_s(options.decide_timeout_s),
        memory(std::move(shared)),
        layout(std::move(where)),
        link(std::move(who), host, std::move(child), std::move(socket), options.last_word_s) {}

  // The memory is copied in before "decide" is sent and copied out after "decided" has arrived. The
  // socket orders the two sides, so the memory needs no lock.
  [[nodiscard]] Status copy_in(const DecideItem& item) const;
  [[nodiscard]] Status copy_messages_in(const DecideItem& item) const;
  void copy_out(const DecideItem& item) const {
    if (layout.command_count > 0) {
      std::memcpy(item.commands, memory.at<Command>(layout.commands),
                  layout.command_count * sizeof(Command));
    }
    if (item.state != nullptr) *item.state = *memory.at<std::uint64_t>(layout.state);
    copy_messages_out(item);
    // Copied before it is checked: the child could change the numbers between check and use.
    const SharedAnswers said = *memory.at<SharedAnswers>(layout.answers);
    if (said.count > 0) {
      take_answers(said, memory.at<std::byte>(layout.answers + sizeof said), item);
    }
  }
  void copy_messages_out(const DecideItem& item) const;

  double timeout_s;
  SharedMemory memory;
  Layout layout;
  Link link;
  bool deciding = false;
  std::uint32_t decision = 0;
  Deadline deadline;
};

Status IsolatedProgram::Impl::copy_in(const DecideItem& item) const {
  for (std::size_t i = 0; i < layout.sensors.size(); ++i) {
    const Layout::Sensor& sensor = layout.sensors[i];
    const SampleHeader header =
        item.sensors[i].header != nullptr ? *item.sensors[i].header : SampleHeader{};
    if (header.count > sensor.capacity) {
      return fail(ErrorCode::kInvalidArgument, "sensor {} has {} records; expected at most {}", i,
                  header.count, sensor.capacity);
    }
    *memory.at<SampleHeader>(sensor.header) = header;
    const std::size_t bytes = std::size_t{header.count} * sensor.record_bytes;
    if (bytes > 0) {
      std::memcpy(memory.at<std::byte>(sensor.records), item.sensors[i].records, bytes);
    }
  }
  RAVE_TRY(copy_messages_in(item));
  *memory.at<SharedDecide>(layout.decide) = {item.now_ns, item.pose, item.decision, item.robot,
                                             item.seed};
  *memory.at<SharedOrders>(layout.orders) =
      write_orders(item, memory.at<std::byte>(layout.orders + sizeof(SharedOrders)));
  // Cleared, so that answers of the last decision do not count again if the program gives none.
  *memory.at<SharedAnswers>(layout.answers) = {};
  *memory.at<std::uint64_t>(layout.state) = 0;
  if (layout.command_count > 0) {
    // The program sees its last commands, as it would inside the host, and may leave them.
    std::memcpy(memory.at<Command>(layout.commands), item.commands,
                layout.command_count * sizeof(Command));
  }
  return {};
}

Status IsolatedProgram::Impl::copy_messages_in(const DecideItem& item) const {
  for (std::size_t c = 0; c < layout.communicators.size(); ++c) {
    const Mailbox& in = *item.communicators[c].in;
    const Layout::Box& box = layout.communicators[c].in;
    if (in.count > box.max_messages || in.bytes > box.max_bytes) {
      return fail(ErrorCode::kInvalidArgument,
                  "communicator {} has {} messages of {} bytes, more than its {} of {}", c,
                  in.count, in.bytes, box.max_messages, box.max_bytes);
    }
    *memory.at<SharedMailbox>(box.state) = {in.count, in.bytes, in.dropped, 0};
    if (in.count > 0) {
      std::memcpy(memory.at<rave::MessageHead>(box.heads), in.heads,
                  in.count * sizeof(rave::MessageHead));
    }
    if (in.bytes > 0) std::memcpy(memory.at<std::byte>(box.data), in.data, in.bytes);
    *memory.at<SharedMailbox>(layout.communicators[c].out.state) = {};
  }
  return {};
}

void IsolatedProgram::Impl::copy_messages_out(const DecideItem& item) const {
  for (std::size_t c = 0; c < layout.communicators.size(); ++c) {
    const Layout::Box& box = layout.communicators[c].out;
    Mailbox& out = *item.communicators[c].out;
    const SharedMailbox state = *memory.at<SharedMailbox>(box.state);
    const auto* heads = memory.at<rave::MessageHead>(box.heads);
    const auto* data = memory.at<std::byte>(box.data);
    // The memory is writable for the child, so skip messages that a correct child could not have
    // sent.
    for (std::uint32_t i = 0; i < std::min(state.count, box.max_messages); ++i) {
      // A copy, because the child could change the head after its check.
      const rave::MessageHead head = heads[i];
      const bool inside = head.size <= box.max_message_bytes && head.offset <= box.max_bytes &&
                          head.size <= box.max_bytes - head.offset;
      if (inside) static_cast<void>(out.put(head, {data + head.offset, head.size}));
    }
    out.dropped += state.dropped;
  }
}

namespace {

struct Sockets {
  Descriptor host;
  Descriptor child;
};

Result<Sockets> make_sockets() {
  int files[2];
  // SEQPACKET keeps the borders of messages and reports the end of the other side, which datagrams
  // do not.
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, files) != 0) {
    return fail(ErrorCode::kIo, "cannot make a socket pair: {}", std::strerror(errno));
  }
  return Sockets{Descriptor(files[0]), Descriptor(files[1])};
}

struct Shared {
  SharedMemory memory;
  Layout layout;
};

Result<Shared> make_shared(const IsolationOptions& options, const ProgramSetup& setup) {
  const std::string bytes =
      encode_setup({options.plugin.string(), options.program, ::getpid()}, setup);
  Layout layout =
      make_layout(bytes.size(), std::span(setup.sensors, setup.sensor_count),
                  std::span(setup.communicators, setup.communicator_count), setup.controller_count);
  RAVE_TRY_ASSIGN(SharedMemory memory, SharedMemory::create(layout.total_bytes));
  *memory.at<SharedHead>(0) = {SharedHead::kMagic, layout.total_bytes, bytes.size()};
  std::memcpy(memory.at<char>(layout.setup), bytes.data(), bytes.size());
  return Shared{std::move(memory), std::move(layout)};
}

}  // namespace

Result<std::unique_ptr<IsolatedProgram>> IsolatedProgram::start(const IsolationOptions& options,
                                                                const ProgramSetup& setup) {
  const std::string who =
      fmt::format("program `{}` of robot `{}`", options.program, setup.robot.name);
  // The upper limit keeps the milliseconds within an int.
  for (const double timeout_s :
       {options.decide_timeout_s, options.start_timeout_s, options.last_word_s}) {
    if (!(timeout_s > 0 && timeout_s <= 1e6)) {
      return fail(ErrorCode::kInvalidArgument,
                  "{}: timeout of {} s; expected more than 0 and at most 1e6 s", who, timeout_s);
    }
  }
  RAVE_TRY_ASSIGN(Shared shared, make_shared(options, setup));
  RAVE_TRY_ASSIGN(Sockets sockets, make_sockets());
  auto child = ChildProcess::spawn({options.runner.string(), options.program, setup.robot.name},
                                   sockets.child.get(), shared.memory.file());
  if (!child) return tl::unexpected(std::move(child).error().with_context(who));
  // The host must not hold the child's end, or it would never see the socket close.
  sockets.child.reset();
  std::unique_ptr<IsolatedProgram> program(new IsolatedProgram(std::make_unique<Impl>(
      options, who, setup.host, std::move(shared.memory), std::move(shared.layout),
      *std::move(child), std::move(sockets.host))));
  RAVE_TRY(program->impl_->link.await(
      MessageKind::kStarted, 0, Deadline(options.start_timeout_s),
      fmt::format("has not started for {}", seconds_text(options.start_timeout_s))));
  return program;
}

IsolatedProgram::IsolatedProgram(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
IsolatedProgram::~IsolatedProgram() = default;

Status IsolatedProgram::begin_decide(const DecideItem& item) {
  Impl& impl = *impl_;
  RAVE_TRY(impl.link.state());
  if (impl.deciding) return fail(ErrorCode::kState, "the program is still deciding");
  RAVE_TRY(impl.copy_in(item));
  impl.decision = item.decision;
  // The time counts from the question and not from end_decide(): all children of the host decide at
  // the same time.
  impl.deadline = Deadline(impl.timeout_s);
  RAVE_TRY(impl.link.ask(item.decision));
  impl.deciding = true;
  return {};
}

Status IsolatedProgram::end_decide(const DecideItem& item) {
  Impl& impl = *impl_;
  RAVE_TRY(impl.link.state());
  if (!impl.deciding) return fail(ErrorCode::kState, "no decision of the program was started");
  // Also if the wait fails, because the link is then closed for good.
  impl.deciding = false;
  RAVE_TRY(impl.link.await(MessageKind::kDecided, impl.decision, impl.deadline,
                           fmt::format("has not decided for {}", seconds_text(impl.timeout_s))));
  impl.copy_out(item);
  return {};
}

Status IsolatedProgram::update(std::span<const ParamValue> params, double radius_m) {
  Impl& impl = *impl_;
  RAVE_TRY(impl.link.state());
  if (impl.deciding) return fail(ErrorCode::kState, "the program is still deciding");
  const std::string bytes = encode_update(params, radius_m);
  if (bytes.size() > kMaxMessageBytes - sizeof(MessageHead)) {
    return fail(ErrorCode::kInvalidArgument, "the parameters take {} bytes; expected at most {}",
                bytes.size(), kMaxMessageBytes - sizeof(MessageHead));
  }
  RAVE_TRY(impl.link.tell(MessageKind::kUpdate, bytes));
  RAVE_TRY(impl.link.await(
      MessageKind::kUpdated, 0, Deadline(impl.timeout_s),
      fmt::format("has not accepted its parameters for {}", seconds_text(impl.timeout_s))));
  const std::string refusal = impl.link.take_refusal();
  if (!refusal.empty()) return fail(ErrorCode::kInvalidArgument, "{}", refusal);
  return {};
}

int IsolatedProgram::process_id() const noexcept { return impl_->link.process_id(); }

}  // namespace rave::isolation
