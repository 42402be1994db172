// SPDX-License-Identifier: Apache-2.0
#include "live_edits.hpp"

#include <algorithm>

#include "manager_habits.hpp"
#include "rave/assemble/obstacles.hpp"
#include "rave/base/names.hpp"
#include "rave/base/open_end.hpp"
#include "rave/control/obstacle_edits.hpp"
#include "rave/control/world_request.hpp"
#include "rave/math/transform.hpp"

namespace rave::manager {
// The world of the manager in real time has no motion. It exists to decide edits: robots are placed
// where they should be by now, the authority checks whether there is room, and all hosts receive
// how the obstacle stands. Each state has a revision, and each host confirms the revision that its
// robots have seen with its next ping. A request is answered when all hosts have confirmed it, or
// after two seconds.
namespace {

using ObstacleKind = sim::ObstacleChange::Kind;

/// Hosts that have not confirmed an edit by then are named in its answer.
constexpr Duration kConfirmation = from_seconds(2);
/// A manager that takes over waits this long for hosts, and for what they have to hand over.
constexpr std::chrono::seconds kComing{1};
constexpr std::chrono::seconds kHandingOver{5};

/// The changes, by id, from the obstacles of the start to the present ones.
std::vector<sim::ObstacleChange> changes_of(
    const std::map<std::uint32_t, real_time::ObstacleSight>& obstacles) {
  std::vector<sim::ObstacleChange> changes;
  for (const auto& [id, sight] : obstacles) {
    changes.push_back(sight.stands);
    if (!sight.removed) continue;
    sim::ObstacleChange& gone = changes.emplace_back();
    gone.kind = ObstacleKind::kRemove;
    gone.id = sight.stands.id;
    gone.name = sight.stands.name;
  }
  return changes;
}

std::uint64_t newest_of(const std::map<std::uint32_t, real_time::ObstacleSight>& obstacles) {
  std::uint64_t newest = 0;
  for (const auto& [id, sight] : obstacles) newest = std::max(newest, sight.revision);
  return newest;
}

}  // namespace

Result<std::unique_ptr<LiveEdits>> LiveEdits::create(sim::EngineSpec spec,
                                                     const LiveManagerOptions& options,
                                                     LiveHosts& hosts) {
  RAVE_TRY(check_scheduled(spec));
  // Live drivers and transmitters of the scenario are permitted, as in the engines of the hosts;
  // this authority runs none of them.
  spec.own_authority = true;
  spec.live_clock = nullptr;
  std::vector<std::uint32_t> host_of(spec.robots.size(), 0);
  RAVE_TRY_ASSIGN(auto authority, sim::WorldAuthority::create(std::move(spec), std::move(host_of)));
  return std::unique_ptr<LiveEdits>(new LiveEdits(options, hosts, std::move(authority)));
}

void LiveEdits::begin(bool takes_over) {
  begun_ = true;
  takes_over_ = takes_over;
  began_ = std::chrono::steady_clock::now();
  if (options_.control == nullptr) return;
  runtime::RunStatus status;
  status.scenario = options_.scenario;
  status.run = options_.bus.run.text();
  const double duration_s = options_.duration.seconds();
  status.duration_s = is_open_end(duration_s) ? 0 : duration_s;
  status.live = true;
  for (const auto& robot : options_.robots) {
    status.robots.push_back({robot.name, robot.simulated, true, false, true});
  }
  serves_ = true;
  options_.control->begin(std::move(status));
}

void LiveEdits::end() {
  waiting_.clear();
  if (std::exchange(serves_, false)) options_.control->end();
}

bool LiveEdits::all_may_be_there() const {
  const bool all = std::all_of(hosts_.slots().begin(), hosts_.slots().end(),
                               [](const LiveSlot& slot) { return slot.writer != 0; });
  // A host that is gone for good must not keep the others without edits.
  return all || std::chrono::steady_clock::now() - began_ >= kComing;
}

/// Receives the obstacles that hosts hand over, once they are present.
Status LiveEdits::gather_handed() {
  if (!all_may_be_there()) return {};
  RAVE_TRY(hosts_.ask_for_handed());
  hosts_.take_handed([this](const real_time::ObstacleSight& sight) {
    return real_time::check_sight(sight, authority_->world());
  });
  return {};
}

/// Whether the hand-over is complete.
bool LiveEdits::handed_over() const {
  if (!all_may_be_there()) return false;
  const auto since = std::chrono::steady_clock::now() - began_;
  // Hosts say with each ping up to which revision they have shown the obstacles. When that one has
  // arrived, nothing newer exists.
  return newest_of(hosts_.handed_obstacles()) >= hosts_.shown_revision() || since >= kHandingOver;
}

/// Added obstacles have consecutive ids, and no host can show one whose predecessor is missing.
void LiveEdits::drop_orphans() {
  std::uint32_t next = authority_->world().body_count();
  auto it = obstacles_.lower_bound(next);
  for (; it != obstacles_.end() && it->first == next; ++it) ++next;
  const auto orphans = std::distance(it, obstacles_.end());
  obstacles_.erase(it, obstacles_.end());
  // Without the missing one the numbers would not fit. A wrong body under a number is worse than a
  // missing one.
  if (orphans == 0) return;
  options_.log->error(kSource,
                      "{} obstacles from hosts are left out: obstacle number {}, which was added "
                      "before them, is missing",
                      orphans, next);
}

/// Restores what the previous manager had published; only the copies of the hosts are left.
Status LiveEdits::take_over(SimTime now) {
  obstacles_ = hosts_.handed_obstacles();
  hosts_.end_handing();
  revision_ = newest_of(obstacles_);
  if (revision_ < hosts_.shown_revision()) {
    options_.log->error(kSource, "hosts have obstacles up to change {}, but sent only {}",
                        hosts_.shown_revision(), revision_);
  }
  // Revisions must not be used twice: hosts would take a new change for an old one and ignore it.
  revision_ = std::max(revision_, hosts_.shown_revision());
  drop_orphans();
  const std::vector<sim::ObstacleChange> changes = changes_of(obstacles_);
  if (auto put = authority_->put_obstacles(changes, now); !put) {
    // The run continues: hosts keep their obstacles, and this manager has only those of the start.
    obstacles_.clear();
    takes_over_ = false;
    options_.log->error(kSource, "the obstacles from hosts are inconsistent: {}",
                        put.error().message);
    return {};
  }
  // The limits of the run hold across managers.
  for (const sim::ObstacleChange& change : changes) limits_.made(change);
  for (const auto& [id, sight] : obstacles_) {
    next_scheduled_ = std::max(
        next_scheduled_,
        // Each state carries how many changes of the scenario were made by then, so this manager
        // continues with the next one. The bound protects from a number that no manager has
        // published.
        std::min<std::size_t>(sight.scheduled, authority_->spec().obstacle_changes.size()));
    RAVE_TRY(publish(sight));
  }
  takes_over_ = false;
  return {};
}

Status LiveEdits::publish(const real_time::ObstacleSight& sight) {
  RAVE_TRY(hosts_.publish(sight));
  published_ = std::max(published_, sight.revision);
  return {};
}

Status LiveEdits::look(SimTime now) {
  if (!begun_) return {};
  follow_hand_overs();
  if (takes_over_) RAVE_TRY(gather_handed());
  // The scenario's own changes wait for the hand-over, or they would get numbers that are already
  // in use.
  if (takes_over_ && handed_over()) RAVE_TRY(take_over(now));
  if (!takes_over_) make_scheduled(now);
  if (!serves_) return {};
  options_.control->set_time(std::max(0.0, now.seconds()));
  for (runtime::RunControl::Asked& asked : options_.control->take()) {
    serve(std::move(asked), now);
  }
  answer_waiting(now);
  return {};
}

void LiveEdits::make_scheduled(SimTime now) {
  const sim::EngineSpec& spec = authority_->spec();
  while (next_scheduled_ < spec.obstacle_changes.size()) {
    const sim::ScheduledObstacle& scheduled = spec.obstacle_changes[next_scheduled_];
    const std::int64_t due_ns = static_cast<std::int64_t>(scheduled.step) * spec.step.ns;
    if (due_ns > std::max<std::int64_t>(0, now.ns)) return;
    ++next_scheduled_;
    const auto made = make(scheduled.change, now);
    if (made) {
      options_.log->info("scenario", "{:.2f} s: {}", now.seconds(), *made);
      continue;
    }
    const auto step = static_cast<std::uint64_t>(std::max<std::int64_t>(0, now.ns) / spec.step.ns);
    refused_.push_back(
        {step, RobotId(), sim::EventKind::kChangeRefused, BodyId(), made.error().text()});
    options_.log->error("scenario", "{:.2f} s: {}", now.seconds(), made.error().message);
  }
}

/// Obstacles may be put where real robots are.
void LiveEdits::follow_hand_overs() {
  for (const real_time::RobotReality& said : hosts_.take_realities()) {
    const std::uint32_t r = said.robot.value();
    const sim::EngineSpec& spec = authority_->spec();
    const sim::RobotSpec& its = spec.robots[r];
    const bool changes = its.twin && spec.types[its.type].simulated != said.simulated &&
                         spec.types[*its.twin].simulated == said.simulated;
    if (!changes) continue;
    const Status changed =
        authority_->change_type(said.robot, *its.twin, authority_->pose(said.robot));
    if (!changed) continue;
    authority_->place(said.robot, authority_->pose(said.robot), hosts_.sight_of(r) != nullptr);
  }
}

/// Where robots should be by now, as far as their hosts have said.
void LiveEdits::place_robots(SimTime now) {
  for (std::uint32_t r = 0; r < options_.robots.size(); ++r) {
    const real_time::RobotSight* const sight = hosts_.sight_of(r);
    if (sight == nullptr) continue;
    const std::int64_t age_ns =
        std::clamp<std::int64_t>((now - sight->stamp).ns, 0, hosts_.staleness(r).ns);
    authority_->place(RobotId(r),
                      integrate(sight->X_WR, sight->velocity, Duration{age_ns}.seconds()), true);
  }
}

Result<std::string> LiveEdits::make(const sim::ObstacleChange& change, SimTime now) {
  // Robots have moved since the last edit; the authority must know where before it looks for room.
  place_robots(now);
  std::string remark;
  RAVE_TRY_ASSIGN(const sim::ObstacleChange made, authority_->decide(change, now, remark));
  limits_.step_done();
  limits_.made(made);
  note(made);
  const sim::Event event = sim::obstacle_event(0, made, remark, {!made.asked.empty(), made.by});
  return fmt::format("{} {}", runtime::word_of(made.kind), event.text);
}

/// Tells the hosts how the obstacle stands now.
void LiveEdits::note(const sim::ObstacleChange& made) {
  auto [place, is_new] = obstacles_.try_emplace(made.id.value());
  real_time::ObstacleSight& sight = place->second;
  if (is_new || sight.stands.kind != ObstacleKind::kAdd) {
    sight.stands = made;
  } else {
    if (made.kind == ObstacleKind::kMove) sight.stands.X_WB = made.X_WB;
    sight.removed = made.kind == ObstacleKind::kRemove;
    sight.stands.asked = made.asked;
  }
  sight.revision = ++revision_;
  sight.scheduled = next_scheduled_;
  const Status told = publish(sight);
  if (!told) {
    options_.log->error(kSource, "obstacle `{}` was not sent: {}", made.name, told.error().message);
  }
}

Result<std::string> LiveEdits::edit(const request::Request& request, SimTime now) {
  const auto* const asked = request.as<request::Edit>();
  if (asked == nullptr) {
    return fail(ErrorCode::kState,
                "in real time each host controls its own robots: send the request to the host that "
                "runs them (`rave ps` lists it; on the bus it is RUN@HOST); this process only "
                "changes obstacles");
  }
  if (takes_over_) {
    return fail(ErrorCode::kState, "this manager is taking over from another one; try again");
  }
  RAVE_TRY_ASSIGN(sim::ObstacleChange change, runtime::requested_change(asked->edit, request.by));
  RAVE_TRY(limits_.take(change, EditLimits::Clock::now()));
  return make(change, now);
}

void LiveEdits::serve(runtime::RunControl::Asked asked, SimTime now) {
  if (asked.request().is<request::ListObstacles>()) {
    asked.answer(runtime::list_obstacles(authority_->world()));
    return;
  }
  auto made = edit(asked.request(), now);
  if (!made) {
    options_.log->warn("by hand", "refused: {}", made.error().message);
    asked.answer(fail(made.error().code, "{}", made.error().message));
    return;
  }
  // The delay that is reported counts from when the request arrived at this process, including its
  // wait for this thread.
  const auto before = std::chrono::steady_clock::now() - asked.since();
  const Duration ago{std::chrono::duration_cast<std::chrono::nanoseconds>(before).count()};
  waiting_.push_back({std::move(asked), revision_, now - ago, *std::move(made)});
}

std::vector<std::string_view> LiveEdits::hosts_without(std::uint64_t revision) const {
  std::vector<std::string_view> names;
  for (const LiveSlot& slot : hosts_.slots()) {
    if (slot.writer != 0 && slot.obstacle_revision < revision) names.emplace_back(slot.name);
  }
  return names;
}

void LiveEdits::answer_waiting(SimTime now) {
  std::erase_if(waiting_, [&](Waiting& one) {
    const auto missing = hosts_without(one.revision);
    // A host that is gone counts as confirmed: when it is back it receives all obstacles before it
    // begins.
    if (!missing.empty() && now - one.since < kConfirmation) return false;
    std::int64_t last_ns = one.since.ns;
    std::size_t hosts = 0;
    for (const LiveSlot& slot : hosts_.slots()) {
      if (slot.writer == 0) continue;
      ++hosts;
      last_ns = std::max(last_ns, slot.obstacles_ns);
    }
    std::string reach;
    if (missing.empty()) {
      const double after_s = Duration{last_ns - one.since.ns}.seconds();
      reach = fmt::format("in effect at all {} hosts {:.1f} ms after the request", hosts,
                          after_s * 1e3);
      edits_.slowest_s = std::max(edits_.slowest_s, after_s);
      edits_.sum_s += after_s;
      ++edits_.confirmed;
    } else {
      reach = fmt::format("not confirmed by {}", join_names(missing));
    }
    ++edits_.made;
    const std::string text = fmt::format("{}; {}", one.text, reach);
    options_.log->info("by hand", "{:.2f} s: {}", now.seconds(), text);
    one.asked.answer(text);
    return true;
  });
}

}  // namespace rave::manager
