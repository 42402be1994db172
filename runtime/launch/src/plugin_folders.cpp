// SPDX-License-Identifier: Apache-2.0
#include "rave/launch/plugin_folders.hpp"

#include <cstdlib>
#include <ranges>
#include <string_view>

#include "rave/assemble/build.hpp"

namespace rave::launch {
namespace {

std::vector<std::string> folders_of_environment() {
  std::vector<std::string> folders;
  const char* const value = std::getenv("RAVE_PLUGIN_PATH");
  for (const auto word : std::views::split(std::string_view(value == nullptr ? "" : value), ':')) {
    if (!word.empty()) folders.emplace_back(word.begin(), word.end());
  }
  return folders;
}

Status add_folders(const std::vector<std::string>& given, const std::filesystem::path& program,
                   plugin::Catalogue& catalogue) {
  for (const std::string& folder : given) {
    if (auto added = catalogue.add_folder(folder); !added) {
      return tl::unexpected(std::move(added).error().with_context("--plugins"));
    }
  }
  for (const std::string& folder : folders_of_environment()) {
    if (auto added = catalogue.add_folder(folder); !added) {
      return tl::unexpected(std::move(added).error().with_context("RAVE_PLUGIN_PATH"));
    }
  }
  // The build tree has the layout of an installation.
  const std::filesystem::path installation = program.parent_path().parent_path();
  return catalogue.add_folder(installation / "lib" / "rave" / "plugins");
}

}  // namespace

Result<std::unique_ptr<plugin::Catalogue>> open_catalogue(const std::vector<std::string>& given,
                                                          const std::filesystem::path& program) {
  auto catalogue = std::make_unique<plugin::Catalogue>(runtime::host_stamp());
  RAVE_TRY(add_folders(given, program, *catalogue));
  return catalogue;
}

}  // namespace rave::launch
