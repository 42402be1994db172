// SPDX-License-Identifier: Apache-2.0
#include "order_post.hpp"

#include <algorithm>
#include <chrono>

namespace rave::direct_line {
namespace {

constexpr std::chrono::seconds kNow{0};
/// The run lets a robot stand whose driver is silent for 200 ms. To say so once more would take the
/// robot from its program.
constexpr std::chrono::seconds kStandsAnyway{1};

bool is_ready(const std::future<Result<std::string>>& answer) {
  return answer.wait_for(kNow) == std::future_status::ready;
}

bool moves(const request::Request& request) {
  const auto* const drive = request.as<request::Drive>();
  return drive != nullptr && !drive->stands();
}

void append(std::string& list, const std::string& text) {
  if (!list.empty()) list += "; ";
  list += text;
}

}  // namespace

void OrderPost::give(Line line, std::vector<request::Request> requests, Answer answer) {
  const bool stop = !requests.empty() && requests.front().is<request::Stop>();
  const auto own = std::ranges::count(waiting_, line, &Waiting::line);
  // A stop is never refused for lack of room.
  if (!stop && static_cast<std::size_t>(own) >= kMostWaiting) {
    return answer(false, "too many orders are waiting");
  }
  Waiting waiting{line, {}, std::move(answer)};
  for (request::Request& request : requests) {
    auto posted = control_.post(std::move(request));
    if (posted) {
      waiting.futures.push_back(*std::move(posted));
    } else {
      append(waiting.refused, posted.error().message);
    }
  }
  waiting_.push_back(std::move(waiting));
}

void OrderPost::drive(Line line, request::Request request, bool echo, Answer answer) {
  Drive& drive = drives_[{line, request.robot}];
  // The sender of a replaced drive command still gets its answer, though the run never receives the
  // command.
  if (auto replaced = std::exchange(drive.next, std::nullopt); replaced && replaced->first) {
    replaced->second(true, "replaced by a newer drive");
  }
  drive.moves = moves(request);
  drive.newest = std::move(request);
  drive.since = std::chrono::steady_clock::now();
  // One at a time: the run takes one velocity per robot and step, so older ones would only make the
  // newest wait.
  if (drive.under_way && !is_ready(*drive.under_way)) {
    drive.next.emplace(echo, std::move(answer));
    return;
  }
  poll(drive);
  begin(drive, echo, std::move(answer));
}

void OrderPost::begin(Drive& drive, bool echo, Answer answer) {
  auto posted = control_.post(drive.newest);
  if (!posted) return answer(false, posted.error().message);
  drive.under_way = *std::move(posted);
  drive.echo = echo;
  drive.answer = std::move(answer);
}

void OrderPost::poll(Drive& drive) {
  if (!drive.under_way || !is_ready(*drive.under_way)) return;
  const auto text = drive.under_way->get();
  drive.under_way.reset();
  const Answer answer = std::exchange(drive.answer, nullptr);
  if (!text) {
    // Another person drives the robot, so the end of this line need not stop it.
    drive.moves = false;
    answer(false, text.error().message);
  } else if (drive.echo) {
    answer(true, *text);
  }
  if (!drive.next) return;
  auto [echo, next] = *std::exchange(drive.next, std::nullopt);
  drive.moves = moves(drive.newest);
  begin(drive, echo, std::move(next));
}

void OrderPost::forget(Line line) {
  const auto now = std::chrono::steady_clock::now();
  for (auto drive = drives_.begin(); drive != drives_.end();) {
    if (drive->first.first != line) {
      ++drive;
      continue;
    }
    if (drive->second.moves && now - drive->second.since < kStandsAnyway) {
      request::Request stand = std::move(drive->second.newest);
      stand.action = request::Drive();
      // The line is gone, so the answer is not needed.
      static_cast<void>(control_.post(std::move(stand)));
    }
    drive = drives_.erase(drive);
  }
  std::erase_if(waiting_, [line](const Waiting& waiting) { return waiting.line == line; });
}

bool OrderPost::take_answers(Waiting& waiting) {
  std::erase_if(waiting.futures, [&waiting](Future& future) {
    if (!is_ready(future)) return false;
    const auto text = future.get();
    append(text ? waiting.done : waiting.refused, text ? *text : text.error().message);
    return true;
  });
  return waiting.futures.empty();
}

void OrderPost::poll() {
  for (auto& [whose, drive] : drives_) poll(drive);
  std::vector<Waiting> ready;
  std::erase_if(waiting_, [&ready](Waiting& waiting) {
    if (!take_answers(waiting)) return false;
    ready.push_back(std::move(waiting));
    return true;
  });
  // After the list has been cleaned up, because an answer is foreign code.
  for (const Waiting& waiting : ready) {
    const bool good = waiting.refused.empty();
    waiting.answer(good, good ? waiting.done : waiting.refused);
  }
}

}  // namespace rave::direct_line
