// SPDX-License-Identifier: Apache-2.0
#include "sweep_folder.hpp"

#include <fmt/format.h>

#include <system_error>

#include "lock.hpp"
#include "rave/base/file.hpp"
#include "rave/codec/nodes.hpp"
#include "rave/config/yaml.hpp"

namespace rave::experiment {
namespace {

namespace fs = std::filesystem;

constexpr const char* kExperiment = "experiment.yaml";
constexpr const char* kPlan = "plan.json";

/// `plan.json`: what read_plan() cannot compute.
struct PlanFile {
  std::vector<std::string> inputs;  ///< Of each condition.
  std::string scenario;
};

template <class V>
void describe(V& v, PlanFile& p) {
  v.required("inputs", p.inputs);
  v.required("scenario", p.scenario);
}

/// A folder keeps to its experiment; a changed file of it is the same experiment.
Status check_owner(const Plan& plan, const fs::path& folder) {
  std::error_code error;
  if (!fs::exists(folder / kExperiment, error)) return {};
  RAVE_TRY_ASSIGN(const auto other, config::read_experiment_file(folder / kExperiment));
  if (*other.name == *plan.experiment.name) return {};
  return fail(ErrorCode::kState,
              "`{}` has the runs of the experiment `{}`; expected an empty folder or one of `{}`",
              folder.string(), *other.name, *plan.experiment.name);
}

}  // namespace

Result<SweepFolder> SweepFolder::open(const Plan& plan, const SweepOptions& options) {
  const bool part = options.shard.count > 1;
  SweepFolder folder(
      options.folder,
      part ? fmt::format("-{}-of-{}", options.shard.index + 1, options.shard.count) : "");
  RAVE_TRY(create_folder(options.folder));
  RAVE_TRY_ASSIGN(folder.whole_, lock_file(options.folder / "lock", part));
  if (part) {
    RAVE_TRY_ASSIGN(folder.own_, lock_file(options.folder / ("lock" + folder.suffix_), false));
  }
  RAVE_TRY(check_owner(plan, options.folder));
  PlanFile file;
  for (const auto& condition : plan.conditions) file.inputs.push_back(condition.inputs);
  file.scenario = plan.scenario.string();
  RAVE_TRY(write_private_file_atomically(options.folder / kExperiment, plan.text));
  RAVE_TRY(write_private_file_atomically(options.folder / kPlan, codec::to_json_line(file) + "\n"));
  std::error_code error;
  fs::remove_all(folder.work(), error);
  RAVE_TRY(create_folder(folder.work()));
  return folder;
}

Result<Plan> read_plan(const fs::path& folder) {
  Plan plan;
  plan.file = folder / kExperiment;
  auto text = read_file(plan.file, config::kMaxFileBytes);
  if (!text) {
    return fail(text.error().code, "`{}` is not the folder of a sweep: {}", folder.string(),
                text.error().message);
  }
  plan.text = *std::move(text);
  RAVE_TRY_ASSIGN(plan.experiment, config::read_experiment_text(plan.text, plan.file.string()));
  RAVE_TRY_ASSIGN(const std::string json, read_file(folder / kPlan, config::kMaxFileBytes));
  constexpr codec::JsonLimits kLimits{.depth = 4, .nodes = 4'000'000};
  RAVE_TRY_ASSIGN(const PlanFile file, codec::from_json<PlanFile>(json, kLimits));
  plan.scenario = file.scenario;
  std::vector<Condition> conditions = conditions_of(plan.experiment);
  if (conditions.size() != file.inputs.size()) {
    return fail(ErrorCode::kParse, "`{}` has {} conditions, and the experiment beside it {}",
                (folder / kPlan).string(), file.inputs.size(), conditions.size());
  }
  for (std::size_t c = 0; c < conditions.size(); ++c) {
    plan.conditions.push_back({std::move(conditions[c]), file.inputs[c], 0});
  }
  return plan;
}

}  // namespace rave::experiment
