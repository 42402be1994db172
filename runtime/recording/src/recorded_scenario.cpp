// SPDX-License-Identifier: Apache-2.0
#include "rave/recording/recorded_scenario.hpp"

#include "rave/record/attached_files.hpp"
#include "rave/recording/provenance.hpp"

namespace rave::runtime {
namespace {

namespace fs = std::filesystem;

/// The inputs of the run that are inside its recording.
config::InputFiles files_inside(const record::McapReader& reader, const record::RunInfo& run,
                                std::vector<std::string>& notes) {
  record::FoundFiles found = record::read_attached_files(reader);
  notes = std::move(found.damages);
  config::InputFiles files;
  for (const auto& [path, digest] : run.inputs) {
    const auto inside = found.files.find(digest);
    if (inside == found.files.end()) continue;
    if (sha256_of(*inside->second.content) == digest) {
      files.add(path, inside->second.content);
    } else {
      notes.push_back(fmt::format("the copy of `{}` in the recording has another SHA-256", path));
    }
  }
  return files;
}

/// Whether what is outside now is what the run read.
void compare_outside(const record::RunInfo& run, RecordedScenario& recorded) {
  for (const auto& [path, content] : recorded.scenario.files.all()) {
    const auto input = run.inputs.find(path);
    if (input == run.inputs.end()) continue;
    if (!recorded.inside.contains(path)) {
      if (sha256_of(*content) == input->second) continue;
      recorded.notes.push_back(fmt::format(
          "`{}` has changed since the recording, which has no copy of it; the changed one is used",
          path));
      continue;
    }
    // One that is gone does not matter any more.
    const auto now = sha256_of_file(path);
    if (!now || *now == input->second) continue;
    recorded.notes.push_back(fmt::format(
        "`{}` has changed since the recording; the one in the recording is used", path));
  }
}

}  // namespace

Result<RecordedScenario> recorded_scenario(const record::McapReader& reader,
                                           const record::RunInfo& run, const fs::path& record) {
  if (run.expanded_scenario.empty()) {
    return fail(ErrorCode::kParse,
                "`{}` has no scenario: its attachment `scenario.yaml` is missing or damaged. Tools "
                "that copy a recording may leave attachments out; use the original",
                record.string());
  }
  RecordedScenario recorded;
  config::InputFiles files = files_inside(reader, run, recorded.notes);
  for (const auto& [path, content] : files.all()) recorded.inside.insert(path);
  auto scenario = config::expand_scenario_text(
      run.expanded_scenario, record.parent_path() / "scenario.yaml", std::move(files));
  if (!scenario) {
    return tl::unexpected(std::move(scenario).error().with_context(
        fmt::format("the scenario inside `{}`", record.string())));
  }
  recorded.scenario = *std::move(scenario);
  compare_outside(run, recorded);
  return recorded;
}

}  // namespace rave::runtime
