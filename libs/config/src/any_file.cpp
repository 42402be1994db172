// SPDX-License-Identifier: Apache-2.0
#include "rave/config/any_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "rave/base/file.hpp"
#include "rave/base/names.hpp"
#include "rave/base/word_table.hpp"
#include "rave/config/yaml.hpp"

namespace rave::config {
namespace {

using codec::RawNode;

constexpr std::array<std::string_view, 8> kRobotKeys = {"body",         "sensors",  "actuators",
                                                        "controllers",  "program",  "pose_from",
                                                        "source_frame", "variables"};
constexpr std::array<std::string_view, 2> kWorldKeys = {"obstacles", "maps"};
constexpr std::array<std::string_view, 3> kExperimentKeys = {"factors", "metrics", "repetitions"};
constexpr std::array<std::string_view, 10> kScenarioKeys = {
    "robots", "name",    "world", "seed",   "duration_s",
    "step_s", "threads", "pace",  "checks", "picture"};

std::size_t count_keys(const RawNode& root, std::span<const std::string_view> keys) {
  return static_cast<std::size_t>(
      std::count_if(keys.begin(), keys.end(), [&](auto key) { return root.find(key) != nullptr; }));
}

Result<RawNode> parse(const std::string& text, const std::filesystem::path& path) {
  codec::Diagnostics diagnostics;
  auto root = parse_yaml(text, path.string(), diagnostics);
  if (!root) return tl::unexpected(diagnostics.joined());
  return *std::move(root);
}

/// Where the robot of a world stands that is checked alone: as far away as files allow.
constexpr std::string_view kBystander = R"(
robots:
  - name: bystander
    pose: {x_m: 999999, y_m: 999999}
    robot: {body: {shapes: [{disc_radius_m: 0.1, z_m: [0, 0.1]}]}}
)";

/// A scenario text around a file, so that it is checked with all that a run would check.
Result<ExpandedScenario> around(std::string_view rest, const std::filesystem::path& path) {
  // The shortest step that scenarios may have, so that every period is a multiple of it.
  const std::string text = fmt::format("name: check\nstep_s: 0.0001\n{}", rest);
  return expand_scenario_text(text, path);
}

std::string quoted(const std::string& file_name) {
  RawNode name = RawNode::mapping();
  name.append("file", RawNode::text(file_name));
  return codec::to_yaml(name);
}

}  // namespace

std::string_view to_string(FileKind kind) noexcept {
  constexpr WordTable<FileKind, 4> kWords = {{{"robot", FileKind::kRobot},
                                              {"world", FileKind::kWorld},
                                              {"scenario", FileKind::kScenario},
                                              {"experiment", FileKind::kExperiment}}};
  return kWords.of(kind);
}

Result<FileKind> recognise(const std::filesystem::path& path) {
  RAVE_TRY_ASSIGN(const std::string text, read_file(path, kMaxFileBytes));
  RAVE_TRY_ASSIGN(const RawNode root, parse(text, path));
  const std::size_t robot = count_keys(root, kRobotKeys);
  const std::size_t world = count_keys(root, kWorldKeys);
  const std::size_t scenario = count_keys(root, kScenarioKeys);
  if (count_keys(root, kExperimentKeys) > 0) return FileKind::kExperiment;
  if (robot > scenario) return FileKind::kRobot;
  if (scenario > 0) return FileKind::kScenario;
  if (world > 0) return FileKind::kWorld;
  const bool has_keys = root.is_mapping() && root.size() > 0;
  return fail_at(
      has_keys ? root.key_where(0) : root.where(), ErrorCode::kParse,
      "found {}; expected a robot file (with `body`), a world file (`obstacles` or `maps`), "
      "a scenario file (`robots`) or an experiment file (`factors`)",
      has_keys
          ? fmt::format("{} {}", root.size() == 1 ? "the key" : "the keys", join_names(root.keys()))
          : root.found_text());
}

Result<AnyFile> read_any_file(const std::filesystem::path& path, Settings settings) {
  RAVE_TRY_ASSIGN(const FileKind kind, recognise(path));
  if (kind == FileKind::kExperiment) {
    return fail(ErrorCode::kInvalidArgument, "`{}` is an experiment file, which has no robots",
                path.string());
  }
  if (kind != FileKind::kScenario && !settings.empty()) {
    return fail(ErrorCode::kInvalidArgument, "--set: expected a scenario, but `{}` is a {} file",
                path.string(), to_string(kind));
  }
  AnyFile input;
  input.kind = kind;
  input.path = path;
  if (kind == FileKind::kScenario) {
    RAVE_TRY_ASSIGN(input.scenario, expand_scenario(path, settings));
    return input;
  }
  const std::string file = quoted(path.filename().string());
  if (kind == FileKind::kRobot) {
    RAVE_TRY_ASSIGN(input.scenario,
                    around(fmt::format("robots:\n  - name: robot\n    pose: {{}}\n    {}", file),
                           path.parent_path() / "check"));
    return input;
  }
  // The world's own errors first, and at their own places.
  RAVE_TRY(read_world_file(path));
  const std::string world = "world" + file.substr(std::string_view("file").size());
  RAVE_TRY_ASSIGN(input.scenario,
                  around(world + std::string(kBystander), path.parent_path() / "check"));
  return input;
}

std::string write_any_file(const AnyFile& input) {
  if (input.kind == FileKind::kRobot) return write_robot(input.scenario.groups[0].robot);
  if (input.kind == FileKind::kWorld) return write_world(input.scenario.world);
  return write_expanded(input.scenario);
}

}  // namespace rave::config
