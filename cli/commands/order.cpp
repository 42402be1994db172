// SPDX-License-Identifier: Apache-2.0
#include "commands/order.hpp"

#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>
#include <vector>

#include "asked_run.hpp"
#include "error_text.hpp"
#include "rave/control/order_words.hpp"
#include "rave/math/scalar.hpp"

namespace rave::cli {
namespace {

using control::Request;
using control::request_of;
using RunKind = runtime::RunRequest::Kind;
using Clock = std::chrono::steady_clock;

/// Well within the time after which a driver counts as gone.
constexpr std::chrono::milliseconds kAgain{50};

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

Result<Request> read_request(const OrderCommand& options) {
  using What = OrderCommand::What;
  switch (options.what) {
    case What::kDrive: {
      Request request = request_of({RunKind::kDrive, options.robot});
      request.run.v_mps = options.numbers[0];
      request.run.w_radps = options.numbers[1];
      return request;
    }
    case What::kGoal: {
      if (options.cancel) return request_of({RunKind::kCancel, options.robot});
      RAVE_TRY_ASSIGN(auto points, points_of(options));
      Request request =
          request_of({points.size() == 1 ? RunKind::kGoal : RunKind::kPath, options.robot});
      // Here as well as in the run, so that a mistake is reported before a run is searched for.
      if (points.size() > 1) RAVE_TRY(runtime::check_path_size(points.size()));
      request.run.points = std::move(points);
      request.run.speed_mps = options.speed_mps;
      return request;
    }
    case What::kSay: {
      Request request = request_of({RunKind::kText, options.robot});
      request.run.value = options.text;
      return request;
    }
    case What::kPlace: {
      Request request = request_of({RunKind::kPlace, options.robot});
      request.run.points = {{options.numbers[0], options.numbers[1]}};
      if (options.numbers.size() > 2) request.run.yaw_rad = deg_to_rad(options.numbers[2]);
      return request;
    }
  }
  return fail(ErrorCode::kInvalidArgument, "no order");
}

/// What came of it, and the process that has the robot.
struct Given {
  int code = kGood;
  const AskedRun* by = nullptr;
};

/// Asks those who may have the robot, and prints what the one says that does.
Given ask(const std::vector<AskedRun>& runs, const Request& request) {
  std::vector<std::pair<const AskedRun*, Error>> refused;
  for (const AskedRun& run : runs) {
    const auto answer = run.ask(request);
    if (answer && answer->good) {
      put(stdout, fmt::format("{}: {}\n", run.name(), answer->text));
      return {kGood, &run};
    }
    refused.emplace_back(&run,
                         answer ? Error{ErrorCode::kState, answer->text, {}} : answer.error());
  }
  Given given{kNotGood, nullptr};
  // Only if all refuse: of several hosts one has the robot, and the others say that they have not.
  for (const auto& [run, why] : refused) {
    complain({why.code, fmt::format("{}: {}", run->name(), why.message), {}});
  }
  return given;
}

/// Keeps driving, and gives the robot back to its program.
int drive_on(const AskedRun& run, const Request& drive, double for_s) {
  const auto end = Clock::now() + std::chrono::duration<double>(for_s);
  while (Clock::now() + kAgain < end) {
    std::this_thread::sleep_for(kAgain);
    const auto answer = run.ask(drive);
    if (!answer) return complain(answer.error());
    if (answer->good) continue;
    complain({ErrorCode::kState, fmt::format("{}: {}", run.name(), answer->text), {}});
    return kNotGood;
  }
  // The last velocity holds until the end, and then the program takes over; without the cancel it
  // would wait until the driver counts as gone.
  std::this_thread::sleep_until(end);
  return ask({run}, request_of({RunKind::kCancel, drive.run.robot})).code;
}

}  // namespace

int give_order(const OrderCommand& options) {
  const auto request = read_request(options);
  if (!request) return complain(request.error());
  const auto run = AskedRun::find(options.run, options.bus);
  if (!run) return complain(run.error());
  const std::vector<AskedRun> runs = run->takers_of_orders(options.robot);
  if (options.force) {
    Request take = request_of({RunKind::kTake, options.robot});
    take.run.value = "force";
    if (const int code = ask(runs, take).code; code != kGood) return code;
  }
  const Given given = ask(runs, *request);
  if (given.by == nullptr || options.what != OrderCommand::What::kDrive) return given.code;
  return drive_on(*given.by, *request, options.for_s);
}

}  // namespace rave::cli
