// SPDX-License-Identifier: Apache-2.0
#include "layout.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "rave/base/names.hpp"

namespace rave::keys {
namespace {

namespace fs = std::filesystem;

bool is_set(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / kCaFolder / kAuthority, error);
}

/// The names of the sets in a folder.
std::vector<std::string> sets_in(const fs::path& parent) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
       entry.increment(error)) {
    if (is_set(entry->path())) names.push_back(entry->path().filename());
  }
  std::ranges::sort(names);
  return names;
}

}  // namespace

fs::path without_slash(const fs::path& folder) {
  return folder.has_filename() ? folder : folder.parent_path();
}

fs::path parent_of(const fs::path& folder) {
  const fs::path parent = without_slash(folder).parent_path();
  return parent.empty() ? "." : parent;
}

Status check_set(const fs::path& folder) {
  if (is_set(folder)) return {};
  const std::vector<std::string> names = sets_in(parent_of(folder));
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string_view near = nearest_name(without_slash(folder).filename().string(), views);
  return fail(ErrorCode::kNotFound, "`{}` is not a set of keys: it has no {}/{}{}", folder.string(),
              kCaFolder, kAuthority, near.empty() ? "" : fmt::format("; did you mean `{}`?", near));
}

}  // namespace rave::keys
