// SPDX-License-Identifier: Apache-2.0
#include "new_project.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>
#include <vector>

#include "rave/base/file.hpp"
#include "rave/base/names.hpp"

namespace rave::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestName = 48;
constexpr std::array<std::string_view, 3> kKinds = {"program", "driver", "panel"};
// Targets that CMake or CTest make by themselves.
constexpr std::array<std::string_view, 10> kReserved = {
    "all",     "clean",         "edit_cache", "help", "install", "list_install_components",
    "package", "rebuild_cache", "test",       "rave"};

bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool is_snake_case(std::string_view name) {
  if (name.empty() || !is_lower(name.front()) || name.back() == '_') return false;
  if (name.find("__") != std::string_view::npos) return false;
  return std::all_of(name.begin(), name.end(),
                     [](char c) { return is_lower(c) || is_digit(c) || c == '_'; });
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos;
       at = text.find(from, at + to.size())) {
    // Searching continues behind what was put in, so a name with the pattern in it cannot loop.
    text.replace(at, from.size(), to);
  }
}

/// `Fastest robots` of `fastest_robots`.
std::string title_of(const std::string& name) {
  std::string title = name;
  std::replace(title.begin(), title.end(), '_', ' ');
  if (is_lower(title.front())) title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return title;
}

std::string filled_in(std::string text, const std::string& name) {
  replace_all(text, "@NAME@", name);
  replace_all(text, "@CLASS@", class_name_of(name));
  replace_all(text, "@TITLE@", title_of(name));
  return text;
}

/// The files below a folder, relative to it, in a fixed order.
Result<std::vector<fs::path>> files_below(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error);
  if (error) return fail(ErrorCode::kNotFound, "no templates in `{}`", folder.string());
  for (const fs::recursive_directory_iterator end; at != end; at.increment(error)) {
    if (error) break;
    if (at->is_regular_file(error)) files.push_back(at->path().lexically_relative(folder));
  }
  if (error) {
    return fail(ErrorCode::kIo, "cannot list `{}`: {}", folder.string(), error.message());
  }
  if (files.empty()) return fail(ErrorCode::kNotFound, "no templates in `{}`", folder.string());
  // A folder is listed in any order; errors should come in the same one everywhere.
  std::sort(files.begin(), files.end());
  return files;
}

Status copy_filled_in(const fs::path& from, const fs::path& to, const std::string& name) {
  RAVE_TRY_ASSIGN(const std::vector<fs::path> files, files_below(from));
  for (const fs::path& file : files) {
    RAVE_TRY_ASSIGN(std::string text, read_file(from / file));
    const fs::path path = to / filled_in(file.string(), name);
    RAVE_TRY(create_folder(path.parent_path()));
    RAVE_TRY(write_file_atomically(path, filled_in(std::move(text), name)));
  }
  return {};
}

}  // namespace

Result<ProjectKind> parse_project_kind(std::string_view text) {
  if (text == kKinds[0]) return ProjectKind::kProgram;
  if (text == kKinds[1]) return ProjectKind::kDriver;
  if (text == kKinds[2]) return ProjectKind::kPanel;
  return fail(ErrorCode::kInvalidArgument, "cannot create a new `{}`{}", text,
              suggestion(text, kKinds));
}

std::string class_name_of(std::string_view project_name) {
  std::string result;
  bool start = true;
  for (const char c : project_name) {
    if (c == '_') {
      start = true;
      continue;
    }
    result += start && is_lower(c) ? static_cast<char>(c - 'a' + 'A') : c;
    start = false;
  }
  return result;
}

Status check_project_name(std::string_view name) {
  if (!is_snake_case(name)) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` is not a valid name: expected lower_snake_case, such as `avoid_walls`", name);
  }
  if (name.size() > kLongestName) {
    return fail(ErrorCode::kInvalidArgument,
                "the name `{}` is too long: expected at most {} characters", name, kLongestName);
  }
  if (std::find(kReserved.begin(), kReserved.end(), name) != kReserved.end()) {
    return fail(ErrorCode::kInvalidArgument,
                "`{}` is not a valid name: it is reserved by the build; choose another", name);
  }
  return {};
}

Status create_project(ProjectKind kind, const std::string& name, const fs::path& template_dir,
                      const fs::path& target_dir) {
  RAVE_TRY(check_project_name(name));
  std::error_code error;
  // The link itself: one that leads nowhere must not be replaced either.
  if (fs::exists(fs::symlink_status(target_dir, error))) {
    return fail(ErrorCode::kInvalidArgument, "`{}` already exists; nothing was changed",
                target_dir.string());
  }
  const fs::path from = template_dir / kKinds[static_cast<std::size_t>(kind)];
  // Written under another name and renamed, so that an error does not leave half of a project.
  fs::path partial = target_dir;
  partial += ".partial";
  Status copied = copy_filled_in(from, partial, name);
  if (copied) fs::rename(partial, target_dir, error);
  std::error_code ignored;
  if (!copied || error) fs::remove_all(partial, ignored);
  if (copied && error) {
    return fail(ErrorCode::kIo, "cannot create `{}`: {}", target_dir.string(), error.message());
  }
  return copied;
}

}  // namespace rave::cli
