// SPDX-License-Identifier: Apache-2.0
#include "rave/control/run_control.hpp"

#include <utility>

namespace rave::runtime {
namespace {

constexpr std::string_view kEnded = "the run has ended";

}  // namespace

void RunControl::pause() {
  const std::lock_guard lock(mutex_);
  paused_ = true;
}

void RunControl::resume() {
  {
    const std::lock_guard lock(mutex_);
    paused_ = false;
    steps_ = 0;
  }
  changed_.notify_all();
}

void RunControl::step(std::uint64_t count) {
  {
    const std::lock_guard lock(mutex_);
    steps_ += count;
  }
  changed_.notify_all();
}

void RunControl::set_pace(double factor) {
  const std::lock_guard lock(mutex_);
  // The status shows it at once; the loop of the run takes it by take_pace().
  status_.pace = factor;
  pace_asked_.store(factor);
}

double RunControl::pace() const {
  const std::lock_guard lock(mutex_);
  return status_.pace;
}

std::optional<double> RunControl::take_pace() {
  // Called in each step, so the cheap look comes first. -1 means that there is no request.
  if (pace_asked_.load(std::memory_order_relaxed) < 0) return std::nullopt;
  const double factor = pace_asked_.exchange(-1);
  return factor < 0 ? std::nullopt : std::optional(factor);
}

bool RunControl::paused() const {
  const std::lock_guard lock(mutex_);
  return paused_;
}

Status RunControl::check_start(std::string_view live_reason) const {
  if (live_reason.empty() || !paused()) return {};
  return fail(ErrorCode::kInvalidArgument, "the run cannot start paused: it is in real time: {}",
              live_reason);
}

Result<std::future<Result<std::string>>> RunControl::post(request::Request request) {
  std::future<Result<std::string>> answer;
  std::stop_source wake(std::nostopstate);
  {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) return fail(ErrorCode::kState, "{}", idle_);
    Pending& pending = pending_.emplace_back();
    pending.request = std::move(request);
    pending.since = std::chrono::steady_clock::now();
    answer = pending.answer.get_future();
    asked_.store(true);
    wake = wake_;
  }
  changed_.notify_all();
  // Without the lock: callbacks of a stop source run in this thread, and may call this object.
  wake.request_stop();
  return answer;
}

Result<std::string> RunControl::ask(request::Request request, std::chrono::milliseconds patience) {
  RAVE_TRY_ASSIGN(auto answer, post(std::move(request)));
  if (answer.wait_for(patience) == std::future_status::ready) return answer.get();
  return fail(ErrorCode::kTimeout,
              "the run has not handled the request for {} ms, because a step does not end; it will "
              "be handled before the next step",
              patience.count());
}

void RunControl::keep_said(request::Request chat) {
  const std::lock_guard lock(mutex_);
  said_.push_back(std::move(chat));
  said_something_.store(true);
}

std::vector<request::Request> RunControl::take_said() {
  if (!said_something_.load()) return {};
  const std::lock_guard lock(mutex_);
  said_something_.store(false);
  return std::exchange(said_, {});
}

RunStatus RunControl::status() const {
  const std::lock_guard lock(mutex_);
  RunStatus status = status_;
  status.sim_s = sim_s_.load();
  status.paused = paused_;
  return status;
}

std::string_view RunControl::idle() const {
  const std::lock_guard lock(mutex_);
  return idle_;
}

void RunControl::begin(RunStatus status) {
  const std::lock_guard lock(mutex_);
  status_ = std::move(status);
  sim_s_.store(0);
  idle_ = {};
}

void RunControl::serve(const Serve& serve, const std::function<void(RunStatus&)>& refresh) {
  serve_or_keep([&serve](const Asked& one) { return serve(one.request()); }, refresh);
}

void RunControl::serve_or_keep(const ServeOrKeep& serve,
                               const std::function<void(RunStatus&)>& refresh) {
  std::vector<Asked> asked = take();
  if (asked.empty()) return;
  // The answers are sent after the status has been updated, so that both agree.
  std::vector<std::optional<Result<std::string>>> answers;
  for (Asked& one : asked) answers.push_back(serve(one));
  this->refresh(refresh);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    if (answers[i]) asked[i].answer(*std::move(answers[i]));
  }
}

std::vector<RunControl::Asked> RunControl::take() {
  std::vector<Asked> asked;
  // Called in each step, so without the lock while there is nothing.
  if (!asked_.load()) return asked;
  const std::lock_guard lock(mutex_);
  for (Pending& one : pending_) {
    asked.emplace_back(std::move(one.request), std::move(one.answer), one.since);
  }
  pending_.clear();
  asked_.store(false);
  wake_ = std::stop_source();
  return asked;
}

std::stop_token RunControl::asked() const {
  const std::lock_guard lock(mutex_);
  return wake_.get_token();
}

bool RunControl::may_step() {
  const std::lock_guard lock(mutex_);
  if (!paused_) return true;
  if (steps_ == 0) return false;
  --steps_;
  return true;
}

RunControl::Asked::Asked(Asked&& other) noexcept
    : request_(std::move(other.request_)),
      promise_(std::move(other.promise_)),
      since_(other.since_),
      open_(std::exchange(other.open_, false)) {}

RunControl::Asked& RunControl::Asked::operator=(Asked&& other) noexcept {
  std::swap(request_, other.request_);
  std::swap(promise_, other.promise_);
  std::swap(since_, other.since_);
  std::swap(open_, other.open_);
  return *this;
}

// A promise without a value would throw `broken_promise` in the thread that waits for it.
RunControl::Asked::~Asked() { answer(fail(ErrorCode::kState, "{}", kEnded)); }

void RunControl::Asked::answer(Result<std::string> text) {
  if (std::exchange(open_, false)) promise_.set_value(std::move(text));
}

void RunControl::set_waits_for(std::string hosts) {
  const std::lock_guard lock(mutex_);
  status_.waits_for = std::move(hosts);
}

void RunControl::refresh(const std::function<void(RunStatus&)>& refresh) {
  const std::lock_guard lock(mutex_);
  refresh(status_);
}

void RunControl::end() {
  const std::lock_guard lock(mutex_);
  idle_ = kEnded;
  status_ = {};
  for (Pending& one : pending_) {
    one.answer.set_value(fail(ErrorCode::kState, "{}", kEnded));
  }
  pending_.clear();
  asked_.store(false);
  wake_ = std::stop_source();
}

bool RunControl::wait_for_turn(const std::function<void()>& serve,
                               const std::function<void()>& held) {
  // A signal handler cannot notify a condition variable, so a paused run polls.
  constexpr auto kLook = std::chrono::milliseconds(50);
  std::unique_lock lock(mutex_);
  while (!stopping()) {
    if (!pending_.empty() && serve) {
      lock.unlock();
      serve();
      lock.lock();
      continue;
    }
    if (!paused_) return true;
    if (steps_ > 0) {
      --steps_;
      return true;
    }
    if (held) {
      lock.unlock();
      held();
      lock.lock();
    }
    changed_.wait_for(lock, kLook);
  }
  return false;
}

}  // namespace rave::runtime
