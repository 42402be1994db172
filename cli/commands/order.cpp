// SPDX-License-Identifier: Apache-2.0
#include "commands/order.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include "asked_run.hpp"
#include "error_text.hpp"
#include "rave/math/scalar.hpp"

namespace rave::cli {
namespace {

using control::Request;
using control::request_of;
using Clock = std::chrono::steady_clock;

/// Well within the time after which a driver counts as gone.
constexpr std::chrono::milliseconds kAgain{50};

/// Of this process: two terminals do not share a lease. JSON carries 53 bits of it.
std::uint64_t own_page() {
  std::random_device chance;
  constexpr std::uint64_t kBits = (std::uint64_t{1} << 53U) - 1;
  return std::max<std::uint64_t>(1, (std::uint64_t{chance()} << 32U | chance()) & kBits);
}

std::atomic<bool> was_suspended{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// The shell, or who else may suspend this process, also wakes it.
void note_suspensions() {
  struct sigaction action {};
  action.sa_handler = [](int) { was_suspended.store(true); };
  action.sa_flags = SA_RESTART;
  ::sigaction(SIGCONT, &action, nullptr);
}

Result<std::vector<Vec2>> points_of(const OrderCommand& options) {
  if (options.numbers.size() % 2 != 0 || options.numbers.empty()) {
    return fail(ErrorCode::kInvalidArgument, "expected X Y, or X Y X Y ...; there are {} numbers",
                options.numbers.size());
  }
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < options.numbers.size(); i += 2) {
    points.push_back({options.numbers[i], options.numbers[i + 1]});
  }
  return points;
}

Result<request::Action> read_action(const OrderCommand& options) {
  using What = OrderCommand::What;
  const std::vector<double>& numbers = options.numbers;
  switch (options.what) {
    case What::kDrive:
      return request::Drive{numbers[0], numbers[1]};
    case What::kGoal: {
      if (options.cancel) return request::Cancel();
      RAVE_TRY_ASSIGN(auto points, points_of(options));
      if (points.size() == 1) return request::Goal{points.front(), {}, options.speed_mps};
      // Here as well as in the run, so that a mistake is reported before a run is searched for.
      RAVE_TRY(request::check_path_size(points.size()));
      return request::Path{std::move(points), options.speed_mps};
    }
    case What::kSay:
      return request::Text{options.text};
    case What::kPlace: {
      request::Place place{{numbers[0], numbers[1]}, {}};
      if (numbers.size() > 2) place.yaw_rad = deg_to_rad(numbers[2]);
      return place;
    }
  }
  return fail(ErrorCode::kInvalidArgument, "no order");
}

/// Asks those who may have the robot, and prints what the one says that does. Returns that process;
/// null if all refuse.
const AskedRun* ask(const std::vector<AskedRun>& runs, const Request& request) {
  std::vector<Error> refusals;
  for (const AskedRun& run : runs) {
    const auto answer = run.ask(request);
    if (answer && answer->good) {
      put(stdout, fmt::format("{}: {}\n", run.name(), answer->text));
      return &run;
    }
    Error why = answer ? Error{ErrorCode::kState, answer->text, {}} : answer.error();
    refusals.push_back(std::move(why).with_context(run.name()));
  }
  // Only if all refuse: of several hosts one has the robot, and the others say that they have not.
  for (const Error& why : refusals) complain(why);
  return nullptr;
}

Request cancel_of(const Request& drive) {
  Request cancel = drive;
  cancel.run.action = request::Cancel();
  return cancel;
}

/// Keeps driving, and gives the robot back to its program.
Result<int> drive_on(const AskedRun& run, const Request& drive, double for_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(for_s);
  while (Clock::now() + kAgain < end) {
    std::this_thread::sleep_for(kAgain);
    if (was_suspended.load()) {
      // The robot stands already, and may even be driven by another one.
      static_cast<void>(run.ask(cancel_of(drive)));
      return refused(run, fmt::format("this command was suspended, so it no longer drives {}",
                                      drive.run.robot));
    }
    RAVE_TRY_ASSIGN(const auto answer, run.ask(drive));
    if (!answer.good) return refused(run, answer.text);
  }
  // The last velocity holds until the end, and then the program takes over; without the cancel it
  // would wait until the driver counts as gone.
  std::this_thread::sleep_until(end);
  return ask({run}, cancel_of(drive)) != nullptr ? kGood : kNotGood;
}

}  // namespace

Result<int> give_order(const OrderCommand& options) {
  RAVE_TRY_ASSIGN(auto action, read_action(options));
  Request request = request_of({std::move(action), options.robot});
  if (options.what == OrderCommand::What::kDrive) request.run.page = own_page();
  note_suspensions();
  RAVE_TRY_ASSIGN(const auto run, AskedRun::find(options.run, options.bus));
  const std::vector<AskedRun> runs = run.takers_of_orders(options.robot);
  if (options.force) {
    Request take = request;
    take.run.action = request::Take{.force = true};
    if (ask(runs, take) == nullptr) return kNotGood;
  }
  const AskedRun* const by = ask(runs, request);
  if (by == nullptr) return kNotGood;
  return options.what == OrderCommand::What::kDrive ? drive_on(*by, request, options.for_s) : kGood;
}

}  // namespace rave::cli
