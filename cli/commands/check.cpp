// SPDX-License-Identifier: Apache-2.0
#include "commands/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <vector>

#include "build_errors.hpp"
#include "error_text.hpp"
#include "experiment_plan.hpp"
#include "places.hpp"
#include "rave/assemble/build.hpp"
#include "rave/assemble/warnings.hpp"
#include "rave/config/any_file.hpp"
#include "rave/drawing/drawing.hpp"
#include "rave/launch/companions.hpp"
#include "rave/sim/engine.hpp"

namespace rave::cli {
namespace {

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string devices_text(const config::RobotFile& robot) {
  std::string text = fmt::format("{}, {}, {}", counted(robot.sensors.size(), "sensor"),
                                 counted(robot.actuators.size(), "actuator"),
                                 counted(robot.controllers.size(), "controller"));
  if (robot.program) text += fmt::format(", program `{}`", robot.program->driver.value);
  return text;
}

/// What a file was taken for and what is in it, in a line.
std::string summary_of(const config::AnyFile& input, const runtime::BuiltScenario& built) {
  const std::size_t obstacles = built.spec.world.obstacles.size();
  std::size_t simulated = 0;
  for (const sim::RobotSpec& robot : built.spec.robots) {
    if (built.spec.types[robot.type].simulated) ++simulated;
  }
  switch (input.kind) {
    case config::FileKind::kRobot:
      return fmt::format("{} robot with {}", simulated == 1 ? "simulated" : "real",
                         devices_text(input.scenario.groups[0].robot));
    case config::FileKind::kWorld:
      return fmt::format("world with {}", counted(obstacles, "obstacle"));
    case config::FileKind::kScenario:
    case config::FileKind::kExperiment:
      break;
  }
  std::set<std::string> drivers;
  for (const sim::RobotType& type : built.spec.types) {
    for (const auto& sensor : type.sensors) drivers.insert(sensor.driver);
    for (const auto& actuator : type.actuators) drivers.insert(actuator.driver);
    for (const auto& controller : type.controllers) drivers.insert(controller.driver);
    if (type.program) drivers.insert(type.program->driver);
  }
  const std::size_t robots = built.spec.robots.size();
  const config::RunLength length = input.scenario.scenario.duration_s;
  return fmt::format("scenario with {} ({} simulated, {} real), {}, {}, {}",
                     counted(robots, "robot"), simulated, robots - simulated,
                     counted(obstacles, "obstacle"), counted(drivers.size(), "driver"),
                     length.is_open() ? "open end" : fmt::format("{:g} s", length.seconds));
}

/// Whether a reading describes what is around the robot; values may.
bool tells_of_surroundings(ReadingKind kind) {
  return kind != ReadingKind::kNone && kind != ReadingKind::kPose &&
         kind != ReadingKind::kOdometry && kind != ReadingKind::kVelocity;
}

/// The first robot of each type whose program drives it without any such reading. That is no error:
/// a program may follow a fixed path.
std::vector<std::string> blind_robots(const sim::EngineSpec& spec) {
  std::vector<std::string> names;
  for (std::uint32_t t = 0; t < spec.types.size(); ++t) {
    const sim::RobotType& type = spec.types[t];
    if (!type.program || type.controllers.empty()) continue;
    if (std::ranges::any_of(type.sensors,
                            [](const auto& s) { return tells_of_surroundings(s.kind); })) {
      continue;
    }
    const auto robot = std::ranges::find(spec.robots, t, &sim::RobotSpec::type);
    if (robot != spec.robots.end()) names.push_back(robot->name);
  }
  return names;
}

class Checker {
 public:
  Checker(const CheckCommand& options, plugin::Catalogue& catalogue)
      : options_(options), catalogue_(catalogue) {}

  [[nodiscard]] int run() {
    int code = kGood;
    for (const std::string& file : options_.files) {
      if (!check_file(file)) code = kBadInput;
    }
    return code;
  }

 private:
  /// A name or a folder stands for its scenario, as for `rave run`.
  [[nodiscard]] static std::string file_of(const std::string& word) {
    std::error_code error;
    if (std::filesystem::is_regular_file(word, error)) return word;
    const auto found = find_scenario(word);
    if (found) return found->string();
    const auto experiment = find_experiment(word);
    return experiment ? experiment->string() : word;
  }

  /// Programs and drivers check what they are given when they start. With hardware that would open
  /// devices, so only runs without any are tried.
  [[nodiscard]] Status try_start(const config::AnyFile& input, const runtime::BuildOptions& how) {
    RAVE_TRY_ASSIGN(auto built, runtime::build(input.scenario, catalogue_, how));
    if (input.kind == config::FileKind::kWorld || !built.live_reason.empty()) return {};
    RAVE_TRY_ASSIGN(const auto engine, sim::Engine::create(std::move(built.spec)));
    return {};
  }

  bool check_file(const std::string& word) {
    const std::string file = file_of(word);
    const auto kind = config::recognise(file);
    if (!kind) return bad(file, "", kind.error());
    if (*kind == config::FileKind::kExperiment) {
      const Status checked = check_experiment(file, catalogue_);
      return checked ? true : bad(file, to_string(*kind), checked.error());
    }
    auto input = config::read_any_file(file, options_.set);
    if (!input) return bad(file, to_string(*kind), input.error());
    runtime::BuildOptions build_options;
    build_options.program_runner = program_runner();
    auto built = runtime::build(input->scenario, catalogue_, build_options);
    if (!built) {
      const Error first = built.error();
      // A build ends at its first error. This looks for all of them, part by part.
      std::vector<Error> errors =
          build_errors(std::move(input->scenario), catalogue_, build_options);
      // An error that no part shows by itself, as between two parts.
      if (errors.empty()) errors.push_back(first);
      for (const Error& error : errors) complain_about(error);
      return verdict(file, to_string(*kind));
    }
    if (auto found = config::find_components(input->scenario.scenario.gui); !found) {
      return bad(file, to_string(*kind), found.error());
    }
    const auto& companions = input->scenario.scenario.companions;
    if (auto found = launch::Companions::find(companions, executable_folder() / "rave"); !found) {
      return bad(file, to_string(*kind), found.error());
    }
    if (auto started = try_start(*input, build_options); !started) {
      return bad(file, to_string(*kind), started.error());
    }
    report_good(file, *input, *built);
    if (options_.expand) put(stdout, config::write_any_file(*input));
    if (!options_.draw.empty()) return draw_file(*input, *std::move(built));
    return true;
  }

  /// The verdict goes beside the errors when the expanded file takes the standard output.
  void report_good(const std::string& file, const config::AnyFile& input,
                   const runtime::BuiltScenario& built) const {
    std::FILE* const stream = options_.expand ? stderr : stdout;
    const Terminal terminal = terminal_of(stream);
    put(stream, fmt::format("{}: {}: {}\n", terminal.bold(file), terminal.green("ok"),
                            summary_of(input, built)));
    tell_warnings(stream, input, built);
    for (const std::string& note : built.notes) {
      put(stream, fmt::format("{}: {} {}\n", terminal.bold(file), terminal.yellow("note:"), note));
    }
    for (const std::string& name : blind_robots(built.spec)) {
      put(stream, fmt::format("{}: {} robot `{}` has no sensor of its surroundings, so its program "
                              "drives blind\n",
                              terminal.bold(file), terminal.yellow("note:"), name));
    }
    if (!built.live_reason.empty()) {
      put(stream, fmt::format("{}: {} runs are live and cannot be repeated: {}\n",
                              terminal.bold(file), terminal.yellow("note:"), built.live_reason));
    }
  }

  /// What is allowed but hardly meant, at its place in a file.
  static void tell_warnings(std::FILE* stream, const config::AnyFile& input,
                            const runtime::BuiltScenario& built) {
    if (input.kind != config::FileKind::kScenario) return;
    const Terminal terminal = terminal_of(stream);
    for (const Error& warning : runtime::warnings_of(input.scenario, built)) {
      put(stream, fmt::format("{}: {} {}\n", terminal.bold(warning.where.text()),
                              terminal.yellow("warning:"), warning.message));
    }
  }

  [[nodiscard]] bool draw_file(const config::AnyFile& input, runtime::BuiltScenario built) const {
    const Status drawn = drawing::draw(input, std::move(built), options_.draw);
    if (!drawn) return complain(drawn.error()) == kGood;
    put(options_.expand ? stderr : stdout, fmt::format("drawn: {}\n", options_.draw));
    return true;
  }

  static void complain_about(const Error& error) {
    put(stderr, error_text(error, terminal_of(stderr)));
  }
  static bool bad(const std::string& file, std::string_view kind, const Error& error) {
    complain_about(error);
    return verdict(file, kind);
  }
  static bool verdict(const std::string& file, std::string_view kind) {
    const Terminal terminal = terminal_of(stderr);
    const std::string taken = kind.empty() ? "" : fmt::format(" (read as a {} file)", kind);
    put(stderr, fmt::format("{}: {}{}\n", terminal.bold(file), terminal.red("not usable"), taken));
    return false;
  }

  const CheckCommand& options_;
  plugin::Catalogue& catalogue_;
};

}  // namespace

Result<int> check(const CheckCommand& options) {
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue(options.plugins));
  if (!options.draw.empty() && options.files.size() > 1) {
    return fail(ErrorCode::kInvalidArgument, "--draw: expected exactly one file");
  }
  return Checker(options, *catalogue).run();
}

}  // namespace rave::cli
