// SPDX-License-Identifier: Apache-2.0
#include "bus_port.hpp"

#include <fmt/format.h>

#include <utility>

namespace rave::gui_server {

namespace {

constexpr auto kStatusEvery = std::chrono::seconds(1);
constexpr Duration kStatusPatience = from_seconds(1);
/// How often the driver of a robot is asked about, who is heard without an answer meanwhile.
constexpr auto kAskDriver = std::chrono::seconds(1);

/// In lock-step the manager has the say, in real time each host of its robots.
bool has_the_say(const control::BusPeer& peer, const std::string& /*scenario*/) {
  return !peer.manager || !peer.live;
}

}  // namespace

BusPort::BusPort(std::unique_ptr<control::BusRun> bus, std::unique_ptr<control::BusRun> status,
                 std::unique_ptr<CommandLine> commands)
    : bus_(std::move(bus)),
      status_(std::move(status)),
      commands_(std::move(commands)),
      thread_([this](const std::stop_token& stop) { work(stop); }),
      watcher_([this](const std::stop_token& stop) { watch(stop); }) {}

BusPort::~BusPort() {
  for (std::jthread* const thread : {&watcher_, &thread_}) {
    thread->request_stop();
    thread->join();
  }
}

std::vector<runtime::RunStatus::Robot> BusPort::robots() const {
  const std::lock_guard lock(mutex_);
  return robots_;
}

void BusPort::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<runtime::RunStatus::Robot> robots;
    for (control::BusReply& reply :
         status_->ask_each(control::Request{}, has_the_say, kStatusPatience)) {
      if (!reply.answer || !reply.answer->good) continue;
      auto& told = reply.answer->status.robots;
      robots.insert(robots.end(), std::make_move_iterator(told.begin()),
                    std::make_move_iterator(told.end()));
    }
    std::unique_lock lock(mutex_);
    robots_ = std::move(robots);
    changed_.wait_for(lock, stop, kStatusEvery, [] { return false; });
  }
}

Result<std::future<Result<std::string>>> BusPort::post(runtime::RunRequest request) {
  const bool drives = request.kind == runtime::RunRequest::Kind::kDrive;
  return drives && commands_ ? drive(request) : queue(std::move(request));
}

Result<std::future<Result<std::string>>> BusPort::drive(const runtime::RunRequest& request) {
  RAVE_TRY(commands_->send(request));
  const auto now = std::chrono::steady_clock::now();
  auto& asked = asked_[request.robot];
  if (now - asked < kAskDriver) {
    std::promise<Answer> said;
    said.set_value(fmt::format("sent to {}", request.robot));
    return said.get_future();
  }
  asked = now;
  runtime::RunRequest take;
  take.kind = runtime::RunRequest::Kind::kTake;
  take.robot = request.robot;
  take.by = request.by;
  take.page = request.page;
  return queue(std::move(take));
}

Result<std::future<Result<std::string>>> BusPort::queue(runtime::RunRequest request) {
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
    promise.set_value(fail(ErrorCode::kState, "the server is shutting down"));
  }
}

BusPort::Answer BusPort::ask(const runtime::RunRequest& request) {
  const control::Request asked = control::request_of(request);
  std::string done;
  std::string refused;
  for (const control::BusReply& reply : bus_->ask_each(asked, has_the_say)) {
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
