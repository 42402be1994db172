// SPDX-License-Identifier: Apache-2.0
#include "bus_port.hpp"

#include <fmt/format.h>

#include <utility>

namespace rave::gui_server {

namespace {

/// Hosts have the say of their robots with both clocks, and no manager is needed for a stop.
bool has_the_say(const run_control::BusPeer& peer, const std::string& /*scenario*/) {
  return !peer.manager;
}

}  // namespace

BusPort::BusPort(std::unique_ptr<run_control::BusRun> bus)
    : bus_(std::move(bus)), thread_([this](const std::stop_token& stop) { work(stop); }) {}

BusPort::~BusPort() {
  thread_.request_stop();
  thread_.join();
}

Result<std::future<Result<std::string>>> BusPort::post(robot_host::RunRequest request) {
  const std::lock_guard lock(mutex_);
  auto& [asked, promise] = waiting_.emplace_back(std::move(request), std::promise<Answer>());
  auto answer = promise.get_future();
  changed_.notify_all();
  return answer;
}

void BusPort::work(const std::stop_token& stop) {
  for (;;) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait(lock, stop, [this] { return !waiting_.empty(); })) break;
    auto [request, promise] = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    promise.set_value(ask(request));
  }
  for (auto& [request, promise] : waiting_) {
    promise.set_value(fail(ErrorCode::kState, "the server ends"));
  }
}

BusPort::Answer BusPort::ask(const robot_host::RunRequest& request) {
  run_control::Request asked;
  const bool stop = request.kind == robot_host::RunRequest::Kind::kStop;
  asked.what = stop ? run_control::Request::What::kStop : run_control::Request::What::kRelease;
  asked.robot = request.robot;
  std::string done;
  std::string refused;
  for (const run_control::BusReply& reply : bus_->ask_each(asked, has_the_say)) {
    const bool good = reply.answer && reply.answer->good;
    std::string& text = good ? done : refused;
    if (!text.empty()) text += "; ";
    text += fmt::format("{}: {}", reply.peer.manager ? "manager" : reply.peer.name,
                        reply.answer ? reply.answer->text : reply.answer.error().message);
  }
  if (done.empty() && refused.empty()) {
    return fail(ErrorCode::kNotFound, "no process of the run answers");
  }
  // A robot is of one host, and the others do not know it.
  const bool whole = refused.empty() || (!request.robot.empty() && !done.empty());
  if (!whole) return fail(ErrorCode::kState, "{}", refused);
  return done;
}

}  // namespace rave::gui_server
