// SPDX-License-Identifier: Apache-2.0
#include "live/bus_port.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "rave/base/thread.hpp"
#include "rave/control/order_desk.hpp"
#include "rave/control/order_words.hpp"

namespace rave::gui_server {

namespace {

constexpr auto kStatusEvery = std::chrono::seconds(1);
constexpr Duration kStatusPatience = from_seconds(1);
/// How often the driver of a robot is asked about, who is heard without an answer meanwhile.
constexpr auto kAskDriver = std::chrono::seconds(1);
constexpr Duration kHostPatience = from_seconds(2);

/// Whether the host of a robot is asked, and no other process: it keeps the lease.
bool is_for_host(runtime::RunRequest::Kind kind) {
  using Kind = runtime::RunRequest::Kind;
  return runtime::OrderDesk::is_for(kind) || kind == Kind::kStop || kind == Kind::kArm ||
         kind == Kind::kResetShadow;
}

/// In lock-step the manager has the say, in real time each host of its robots.
bool has_the_say(const control::BusPeer& peer, const std::string& /*scenario*/) {
  return !peer.manager || !peer.live;
}

}  // namespace

Result<std::unique_ptr<BusPort>> BusPort::open(std::unique_ptr<control::BusRun> bus,
                                               std::unique_ptr<control::BusRun> status,
                                               const bus::BusConfig& config,
                                               const std::vector<std::string>& robots,
                                               std::map<std::string, std::string> host_of) {
  std::unique_ptr<BusPort> port(new BusPort(std::move(bus), std::move(status), std::move(host_of)));
  BusPort* const self = port.get();
  RAVE_TRY_ASSIGN(port->commands_,
                  control::CommandSender::open(config, robots, [self] { self->stir(); }));
  RAVE_TRY(start_thread(port->thread_, "requests of pages",
                        [self](const std::stop_token& stop) { self->work(stop); }));
  RAVE_TRY(start_thread(port->watcher_, "the status of robots",
                        [self](const std::stop_token& stop) { self->watch(stop); }));
  return port;
}

BusPort::~BusPort() {
  for (std::jthread* const thread : {&watcher_, &thread_}) {
    thread->request_stop();
    if (thread->joinable()) thread->join();
  }
}

void BusPort::stir() {
  const std::lock_guard lock(mutex_);
  stirred_ = true;
  changed_.notify_all();
}

std::vector<runtime::RunStatus::Robot> BusPort::robots() const {
  const std::lock_guard lock(mutex_);
  return robots_;
}

void BusPort::watch(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    std::vector<runtime::RunStatus::Robot> robots;
    std::vector<runtime::RunStatus::Robot> of_manager;
    for (control::BusReply& reply :
         status_->ask_each(control::Request{}, has_the_say, kStatusPatience)) {
      if (!reply.answer || !reply.answer->good) continue;
      auto& told = reply.answer->status.robots;
      auto& all = reply.peer.manager ? of_manager : robots;
      all.insert(all.end(), std::make_move_iterator(told.begin()),
                 std::make_move_iterator(told.end()));
    }
    std::unique_lock lock(mutex_);
    // Hosts know more of their robots than a manager.
    robots_ = robots.empty() ? std::move(of_manager) : std::move(robots);
    changed_.wait_for(lock, stop, kStatusEvery, [this] { return stirred_; });
    stirred_ = false;
  }
}

Result<std::future<Result<std::string>>> BusPort::post(runtime::RunRequest request) {
  if (request.kind == runtime::RunRequest::Kind::kDrive) return drive(request);
  // Only one order names no robot: a cancel of all, which is a request to each process.
  const bool order = runtime::is_order(request.kind) && !request.robot.empty();
  return order ? commands_->post(std::move(request)) : queue(std::move(request));
}

Result<std::future<Result<std::string>>> BusPort::drive(const runtime::RunRequest& request) {
  RAVE_TRY_ASSIGN(auto sent, commands_->post(request));
  const auto now = std::chrono::steady_clock::now();
  auto& asked = asked_[request.robot];
  if (now - asked < kAskDriver) return sent;
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
    stir();
  }
  for (auto& [request, promise] : waiting_) {
    promise.set_value(fail(ErrorCode::kState, "the server is shutting down"));
  }
}

BusPort::Answer BusPort::ask(const runtime::RunRequest& request) {
  const control::Request asked = control::request_of(request);
  const auto host = host_of_.find(request.robot);
  if (host != host_of_.end() && is_for_host(request.kind)) return ask_host(host->second, asked);
  const bool of_hosts = runtime::OrderDesk::is_for(request.kind);
  const auto meant = [of_hosts](const control::BusPeer& peer, const std::string& scenario) {
    return of_hosts ? !peer.manager : has_the_say(peer, scenario);
  };
  std::string done;
  std::string refused;
  for (const control::BusReply& reply : bus_->ask_each(asked, meant)) {
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

BusPort::Answer BusPort::ask_host(const std::string& host, const control::Request& request) {
  RAVE_TRY_ASSIGN(const control::BusPeer peer, bus_->find(host, kHostPatience));
  RAVE_TRY_ASSIGN(const control::Answer answer, bus_->ask(peer, request));
  if (!answer.good) return fail(ErrorCode::kState, "{}", answer.text);
  return answer.text;
}

std::vector<runtime::RunStatus::Robot> ManagedPort::robots() const {
  std::vector<runtime::RunStatus::Robot> robots = manager_.status().robots;
  std::map<std::string_view, runtime::RunStatus::Robot*> by_name;
  for (runtime::RunStatus::Robot& robot : robots) by_name.emplace(robot.name, &robot);
  for (runtime::RunStatus::Robot& told : hosts_->robots()) {
    const auto robot = by_name.find(told.name);
    if (robot == by_name.end()) continue;
    // Who drives and who is stopped the manager learns sooner.
    robot->second->armed = told.armed;
    robot->second->takes = std::move(told.takes);
    robot->second->order = std::move(told.order);
    robot->second->changed = std::move(told.changed);
  }
  return robots;
}

Result<std::future<Result<std::string>>> ManagedPort::post(runtime::RunRequest request) {
  const bool of_hosts = runtime::OrderDesk::is_for(request.kind);
  return of_hosts ? hosts_->post(std::move(request)) : manager_.post(std::move(request));
}

}  // namespace rave::gui_server
