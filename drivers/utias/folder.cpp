// SPDX-License-Identifier: Apache-2.0
#include "utias/folder.hpp"

#include <charconv>
#include <set>
#include <system_error>

#include "rave/base/file.hpp"
#include "utias/recording_names.hpp"

namespace rave::utias {
namespace {

bool is_file(const std::filesystem::path& path) noexcept {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored);
}

/// The N of `RobotN_…`, or 0.
int robot_number(std::string_view name) noexcept {
  constexpr std::string_view kPrefix = "Robot";
  if (!name.starts_with(kPrefix)) return 0;
  name.remove_prefix(kPrefix.size());
  int number = 0;
  const auto [stop, status] = std::from_chars(name.data(), name.data() + name.size(), number);
  // The underscore is required, so that `Robot1` does not match `Robot12_…`.
  const bool named = status == std::errc() && stop != name.data() + name.size() && *stop == '_';
  return named && number > 0 ? number : 0;
}

}  // namespace

Result<Folder> Folder::open(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) {
    return fail(ErrorCode::kNotFound, "there is no folder `{}` with UTIAS logs", path.string());
  }
  Folder folder;
  folder.path_ = path;
  RAVE_TRY(folder.find_robots());
  RAVE_TRY_ASSIGN(folder.stretch_, recording::read_stretch(path));
  return folder;
}

Status Folder::find_robots() {
  std::set<int> found;
  std::error_code status;
  std::filesystem::directory_iterator entry(path_, status);
  while (!status && entry != std::filesystem::directory_iterator()) {
    const int number = robot_number(entry->path().filename().string());
    if (number > 0) found.insert(number);
    entry.increment(status);
  }
  if (status) {
    return fail(ErrorCode::kIo, "cannot list `{}`: {}", path_.string(), status.message());
  }
  robots_.assign(found.begin(), found.end());
  return {};
}

Result<LogFile> Folder::read(std::string_view stem, std::span<const Column> columns,
                             bool accept_cut) const {
  const std::string plain = std::string(stem) + ".dat";
  const std::string packed = plain + ".gz";
  // The packed file is preferred if both exist.
  const std::filesystem::path path = path_ / (is_file(path_ / packed) ? packed : plain);
  if (!is_file(path)) {
    return fail(ErrorCode::kNotFound, "`{}` has neither `{}` nor `{}`", path_.string(), packed,
                plain);
  }
  LogFile file;
  file.path = path.string();
  RAVE_TRY_ASSIGN(const std::string bytes, read_file(path, recording::kMostLogBytes));
  RAVE_TRY_ASSIGN(const UnpackedText text, unpack_text(bytes, file.path));
  RAVE_TRY_ASSIGN(file.log, parse_log(text, file.path, columns, accept_cut));
  // Last, so that a syntax error is reported with its line instead.
  RAVE_TRY_ASSIGN(file.identity, recording::identify(path, bytes, file.log.repairs, stretch_));
  return file;
}

}  // namespace rave::utias
