// SPDX-License-Identifier: Apache-2.0
#include "commands/new.hpp"

#include <fmt/format.h>

#include "error_text.hpp"
#include "new_project.hpp"
#include "places.hpp"
#include "rave/process/shell_word.hpp"

namespace rave::cli {
namespace {

/// Folders of one's own are searched first, so a project with the name of something that comes with
/// RAVE would replace it in every scenario that is run with them.
Status hides_nothing(ProjectKind kind, const std::string& name) {
  if (kind == ProjectKind::kPanel) return {};
  RAVE_TRY_ASSIGN(const auto catalogue, open_catalogue({}));
  for (std::uint32_t k = 0; k < kDriverKindCount; ++k) {
    const auto driver_kind = static_cast<DriverKind>(k);
    if (!catalogue->find({&driver_kind, 1}, name)) continue;
    return fail(ErrorCode::kInvalidArgument,
                "`{}` is the name of a {} that comes with RAVE, which yours would hide; choose "
                "another",
                name, to_string(driver_kind));
  }
  return {};
}

}  // namespace

Result<int> new_project(const NewCommand& options) {
  RAVE_TRY_ASSIGN(const auto kind, parse_project_kind(options.kind));
  RAVE_TRY(hides_nothing(kind, options.name));
  const std::string folder = options.directory.empty() ? options.name : options.directory;
  RAVE_TRY(create_project(kind, options.name, share_folder() / "templates", folder));
  if (kind == ProjectKind::kPanel) {
    put(stdout, fmt::format("created {0}; edit {0}/{1}.mjs\n\nnext:\n"
                            "  node --test {2}\n\n"
                            "then name it in a scenario, and run that with --gui:\n"
                            "  gui:\n    components:\n"
                            "      - {{module: {0}/{1}.mjs, roles: [observer, commander]}}\n",
                            folder, options.name, process::shell_word(folder)));
    return kGood;
  }
  const std::string prefix = executable_folder().parent_path().string();
  const std::string shell_folder = process::shell_word(folder);
  const std::string build = process::shell_word(folder + "/build");
  put(stdout, fmt::format("created {0}; edit {0}/{1}.cpp\n\nnext:\n"
                          "  cmake -S {2} -B {3} -DCMAKE_PREFIX_PATH={4}\n"
                          "  cmake --build {3}\n"
                          "  rave describe {1} --plugins {3}\n",
                          folder, options.name, shell_folder, build, process::shell_word(prefix)));
  put(stdout,
      "then name it as `driver:` in a robot file, and pass --plugins to `rave run` or set "
      "RAVE_PLUGIN_PATH\n");
  return kGood;
}

}  // namespace rave::cli
