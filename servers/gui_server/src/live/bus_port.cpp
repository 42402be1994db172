// SPDX-License-Identifier: Apache-2.0
#include "live/bus_port.hpp"

#include <fmt/format.h>

#include <string_view>
#include <utility>

#include "rave/base/thread.hpp"
#include "rave/control/order_desk.hpp"

namespace rave::gui_server {

namespace {

constexpr auto kStatusEvery = std::chrono::seconds(1);
constexpr Duration kStatusPatience = from_seconds(1);
/// How often the driver of a robot is asked about, who is heard without an answer meanwhile.
constexpr auto kAskDriver = std::chrono::seconds(1);
constexpr Duration kHostPatience = from_seconds(2);
/// A host that does not answer must not delay the next stop for longer.
constexpr Duration kHoldPatience = from_seconds(1);

bool is_host(const control::BusPeer& peer, const std::string& /*scenario*/) {
  return !peer.manager;
}

/// What a host hears of its manager; nothing: it hears nothing.
std::optional<RunHold> hold_of_manager(control::BusRun& bus, const control::BusPeer& host) {
  control::Request status;
  status.relay = true;
  const auto answer = bus.ask(host, status, kStatusPatience);
  if (!answer || !answer->good) return std::nullopt;
  return RunHold{answer->status.paused, answer->status.pace};
}

/// What processes of a run answer to one request.
struct Replies {
  std::string done;
  std::string refused;

  void add(std::string_view from, bool good, std::string_view text) {
    std::string& said = good ? done : refused;
    if (!said.empty()) said += "; ";
    said += fmt::format("{}: {}", from, text);
  }
  void add(const std::vector<control::BusReply>& replies) {
    for (const control::BusReply& reply : replies) {
      add(reply.peer.name, reply.answer && reply.answer->good,
          reply.answer ? reply.answer->text : reply.answer.error().message);
    }
  }
  /// `one`: it is enough that one of them has done it.
  [[nodiscard]] Result<std::string> result(bool one) const {
    if (done.empty() && refused.empty()) {
      return fail(ErrorCode::kNotFound, "no process of the run answers");
    }
    if (refused.empty() || (one && !done.empty())) return done;
    if (done.empty()) return fail(ErrorCode::kState, "{}", refused);
    return fail(ErrorCode::kState, "{}; {}", refused, done);
  }
};

Result<std::string> ask_host(control::BusRun& bus, const std::string& host,
                             const control::Request& request) {
  RAVE_TRY_ASSIGN(const control::BusPeer peer, bus.find(host, kHostPatience));
  RAVE_TRY_ASSIGN(const control::Answer answer, bus.ask(peer, request));
  if (!answer.good) return fail(ErrorCode::kState, "{}", answer.text);
  return answer.text;
}

}  // namespace

Result<std::unique_ptr<BusPort>> BusPort::open(const bus::BusConfig& bus, bool lock_step,
                                               const std::vector<std::string>& robots,
                                               std::map<std::string, std::string> host_of) {
  RAVE_TRY_ASSIGN(auto status, control::BusRun::open(bus, "GUI Server"));
  std::unique_ptr<BusPort> port(new BusPort(std::move(status), lock_step, std::move(host_of)));
  BusPort* const self = port.get();
  RAVE_TRY_ASSIGN(port->commands_,
                  control::CommandSender::open(bus, robots, [self] { self->stir(); }));
  RAVE_TRY_ASSIGN(port->holds_, RequestLane::open(bus));
  RAVE_TRY_ASSIGN(port->requests_, RequestLane::open(bus));
  RAVE_TRY(start_thread(port->watcher_, "the status of robots",
                        [self](const std::stop_token& stop) { self->watch(stop); }));
  return port;
}

BusPort::~BusPort() {
  watcher_.request_stop();
  if (watcher_.joinable()) watcher_.join();
}

std::future<BusPort::Answer> BusPort::send(RequestLane& lane,
                                           Answer (BusPort::*how)(control::BusRun&,
                                                                  const request::Request&),
                                           request::Request request) {
  return lane.queue([this, how, request = std::move(request)](control::BusRun& bus) {
    Answer answer = (this->*how)(bus, request);
    stir();
    return answer;
  });
}

RunHold BusPort::held() const {
  const std::lock_guard lock(mutex_);
  return hold_;
}

void BusPort::hold(const TransportMessage& transport) {
  using Do = TransportMessage::Do;
  std::vector<control::ProcessAction> actions;
  {
    // Shown at once; what the manager says of before does not take it back.
    const std::lock_guard lock(mutex_);
    if (transport.what == Do::kPace) {
      hold_.pace = transport.value;
      actions.emplace_back(control::Pace{transport.value});
    } else {
      hold_.paused = transport.what != Do::kPlay;
      if (hold_.paused) actions.emplace_back(control::Pause());
      if (transport.what == Do::kPlay) actions.emplace_back(control::Resume());
      if (transport.what == Do::kStep) {
        actions.emplace_back(control::Step{static_cast<std::uint64_t>(transport.value)});
      }
    }
    ++holds_asked_;
  }
  static_cast<void>(requests_->queue([this, actions](control::BusRun& bus) -> Answer {
    Answer answer = fail(ErrorCode::kState, "nothing was asked");
    for (const control::ProcessAction& action : actions) {
      control::Request request;
      request.own = action;
      answer = ask_manager(bus, "", std::move(request));
    }
    {
      const std::lock_guard lock(mutex_);
      --holds_asked_;
    }
    stir();
    return answer;
  }));
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
    std::unique_lock asking(mutex_);
    const bool asked = holds_asked_ > 0;
    asking.unlock();
    std::optional<control::BusPeer> host;
    for (control::BusReply& reply :
         status_->ask_each(control::Request{}, is_host, kStatusPatience)) {
      if (!reply.answer || !reply.answer->good) continue;
      host = reply.peer;
      auto& told = reply.answer->status.robots;
      robots.insert(robots.end(), std::make_move_iterator(told.begin()),
                    std::make_move_iterator(told.end()));
    }
    const auto hold = host && lock_step_ ? hold_of_manager(*status_, *host) : std::nullopt;
    std::unique_lock lock(mutex_);
    robots_ = std::move(robots);
    if (hold && !asked && holds_asked_ == 0) hold_ = *hold;
    changed_.wait_for(lock, stop, kStatusEvery, [this] { return stirred_; });
    stirred_ = false;
  }
}

Result<std::future<Result<std::string>>> BusPort::post(request::Request request) {
  if (request.is<request::Drive>()) return drive(request);
  const bool hold = request::is_hold(request.action);
  if (request.robot.empty() && hold) {
    return send(*holds_, &BusPort::hold_all, std::move(request));
  }
  // A cancel of all names no robot: it is a request to each host.
  const bool command = (hold || request::is_order(request.action)) && !request.robot.empty();
  if (command) return commands_->post(std::move(request));
  return send(*requests_, &BusPort::ask, std::move(request));
}

Result<std::future<Result<std::string>>> BusPort::drive(const request::Request& request) {
  RAVE_TRY_ASSIGN(auto sent, commands_->post(request));
  const auto now = std::chrono::steady_clock::now();
  auto& asked = asked_[request.robot];
  if (now - asked < kAskDriver) return sent;
  asked = now;
  return send(*requests_, &BusPort::ask,
              {request::Take{.force = false, .drives = true}, request.robot, request.by, false,
               request.page});
}

BusPort::Answer BusPort::ask(control::BusRun& bus, const request::Request& request) {
  const auto* const set = request.as<request::Set>();
  const bool of_body = set != nullptr && set->key.starts_with("body.");
  const bool of_world = request.is<request::Edit, request::ListObstacles>() ||
                        (lock_step_ && (of_body || request.is<request::Chat>()));
  if (of_world) return ask_manager(bus, request.robot, control::request_of(request));
  const auto host = host_of_.find(request.robot);
  if (host != host_of_.end()) return ask_host(bus, host->second, control::request_of(request));
  Replies replies;
  replies.add(bus.ask_each(control::request_of(request), is_host));
  return replies.result(!request.robot.empty());
}

BusPort::Answer BusPort::hold_all(control::BusRun& bus, const request::Request& request) {
  Replies replies;
  replies.add(bus.ask_each(control::request_of(request), is_host, kHoldPatience));
  // In lock-step the manager also knows the robots of hosts that are lost and may come back.
  if (lock_step_) {
    const Answer managed = ask_manager(bus, request.robot, control::request_of(request));
    replies.add("manager", managed.has_value(), managed ? *managed : managed.error().message);
  }
  return replies.result(false);
}

BusPort::Answer BusPort::ask_manager(control::BusRun& bus, const std::string& robot,
                                     control::Request request) {
  request.relay = true;
  const auto host = host_of_.find(robot);
  if (host != host_of_.end()) return ask_host(bus, host->second, request);
  const std::vector<control::BusPeer> hosts = bus.all(kHostPatience);
  if (hosts.empty()) return fail(ErrorCode::kNotFound, "no process of the run answers");
  return ask_host(bus, hosts.front().name, request);
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

Result<std::future<Result<std::string>>> ManagedPort::post(request::Request request) {
  const bool of_hosts = runtime::OrderDesk::is_for(request.action);
  return of_hosts ? hosts_->post(std::move(request)) : manager_.post(std::move(request));
}

}  // namespace rave::gui_server
