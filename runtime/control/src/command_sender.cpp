// SPDX-License-Identifier: Apache-2.0
#include "rave/control/command_sender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "rave/base/thread.hpp"
#include "rave/bus/reader.hpp"
#include "rave/bus/sequence.hpp"
#include "rave/bus/wait_set.hpp"
#include "rave/bus/writer.hpp"
#include "rave/control/commands.hpp"
#include "repeat.hpp"

namespace rave::control {
namespace {

using Clock = std::chrono::steady_clock;

/// How long an order waits for its answer.
constexpr std::chrono::seconds kOrderPatience{5};

struct Order {
  request::Request request;
  std::uint32_t robot = 0;
  std::promise<Result<std::string>> promise{};
  Clock::time_point until = Clock::now() + kOrderPatience;
  Repeat repeat{};
};

}  // namespace

struct CommandSender::Impl {
  std::unique_ptr<bus::Bus> bus;
  bus::Writer<bus::Command> commands{};
  bus::Reader<bus::CommandAnswer> answers{};
  bus::WaitSet waits{};
  std::map<std::string, std::uint32_t, std::less<>> ids{};
  std::function<void()> answered{};
  std::mutex mutex{};
  std::vector<Order> posted{};  ///< Of all threads.
  // The rest is of the sender's own thread.
  std::map<std::uint64_t, Order> open{};  ///< By number.
  std::uint64_t number = 0;               ///< That of the last command.
  std::jthread thread{};

  void work(const std::stop_token& stop);
  void take_posted();
  void take_answers();
  [[nodiscard]] Status send(std::uint64_t command_number, const Order& order);
  [[nodiscard]] bool send_if_due(std::uint64_t command_number, Order& order, Clock::time_point now);
  [[nodiscard]] Clock::time_point send_due();
};

void CommandSender::Impl::work(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    take_posted();
    take_answers();
    const Clock::time_point next = send_due();
    static_cast<void>(waits.wait(bus::left_until(next), stop));
  }
  take_posted();
  for (auto& [command_number, order] : open) {
    order.promise.set_value(fail(ErrorCode::kState, "the server is shutting down"));
  }
}

/// Numbers are given here, so commands leave in the order of their numbers, which their hosts
/// require.
void CommandSender::Impl::take_posted() {
  const std::lock_guard lock(mutex);
  for (Order& order : posted) open.emplace(++number, std::move(order));
  posted.clear();
}

void CommandSender::Impl::take_answers() {
  bool any = false;
  answers.take([this, &any](const bus::CommandAnswer& answer) {
    if (answer.target != bus->writer()) return;
    const auto order = open.find(answer.number);
    if (order == open.end() || order->second.robot != answer.robot) return;
    const std::string text(bus::text_of(answer.text));
    if (answer.accepted) {
      order->second.promise.set_value(text);
    } else {
      order->second.promise.set_value(fail(ErrorCode::kState, "{}", text));
    }
    open.erase(order);
    any = true;
  });
  if (any && answered) answered();
}

Status CommandSender::Impl::send(std::uint64_t command_number, const Order& order) {
  bus::Command command;
  std::vector<rave_wire_OrderPoint> points;
  RAVE_TRY(to_command(order.request, command, points));
  command.robot = order.robot;
  command.number = command_number;
  return commands.write(command);
}

/// Sends an order if that is due. Whether it has its answer: an error, or that of a drive.
bool CommandSender::Impl::send_if_due(std::uint64_t command_number, Order& order,
                                      Clock::time_point now) {
  const std::string& robot = order.request.robot;
  if (now >= order.until) {
    order.promise.set_value(
        fail(ErrorCode::kTimeout,
             "the host of {} has not answered for {} s; the order may still be carried out", robot,
             kOrderPatience.count()));
    return true;
  }
  if (!order.repeat.due(now)) return false;
  if (Status sent = send(command_number, order); !sent) {
    order.promise.set_value(tl::unexpected(std::move(sent).error()));
    return true;
  }
  if (order.request.is<request::Drive>()) {
    order.promise.set_value(fmt::format("sent to {}", robot));
    return true;
  }
  order.repeat.sent(now);
  return false;
}

/// Sends what is due, and returns when to do so again.
Clock::time_point CommandSender::Impl::send_due() {
  const Clock::time_point now = Clock::now();
  Clock::time_point next = now + kOrderPatience;
  for (auto order = open.begin(); order != open.end();) {
    if (send_if_due(order->first, order->second, now)) {
      order = open.erase(order);
    } else {
      next = std::min({next, order->second.repeat.next(), order->second.until});
      ++order;
    }
  }
  return next;
}

CommandSender::CommandSender(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

CommandSender::~CommandSender() {
  impl_->thread.request_stop();
  if (impl_->thread.joinable()) impl_->thread.join();
}

Result<std::unique_ptr<CommandSender>> CommandSender::open(bus::BusConfig config,
                                                           const std::vector<std::string>& robots,
                                                           std::function<void()> answered) {
  // Other processes must not count this one as a participant of the run.
  config.anonymous = true;
  auto impl = std::make_unique<Impl>();
  RAVE_TRY_ASSIGN(impl->bus, bus::Bus::open(config));
  RAVE_TRY(bus::open_all(*impl->bus, impl->commands, impl->answers));
  RAVE_TRY_ASSIGN(impl->waits, bus::WaitSet::create(*impl->bus));
  RAVE_TRY(impl->waits.add(impl->answers));
  for (std::uint32_t r = 0; r < robots.size(); ++r) impl->ids.emplace(robots[r], r);
  impl->answered = std::move(answered);
  Impl* const work = impl.get();
  RAVE_TRY(start_thread(impl->thread, "the sender of orders",
                        [work](const std::stop_token& stop) { work->work(stop); }));
  return std::unique_ptr<CommandSender>(new CommandSender(std::move(impl)));
}

Result<std::future<Result<std::string>>> CommandSender::post(request::Request order) {
  const auto id = impl_->ids.find(order.robot);
  if (id == impl_->ids.end()) {
    return fail(ErrorCode::kNotFound, "there is no robot `{}`", order.robot);
  }
  bus::Command checked;
  std::vector<rave_wire_OrderPoint> points;
  RAVE_TRY(to_command(order, checked, points));
  std::future<Result<std::string>> answer;
  {
    const std::lock_guard lock(impl_->mutex);
    Order& posted = impl_->posted.emplace_back(Order{std::move(order), id->second});
    answer = posted.promise.get_future();
  }
  impl_->waits.ring();
  return answer;
}

}  // namespace rave::control
