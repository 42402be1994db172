// SPDX-License-Identifier: Apache-2.0
#include "run_folder.hpp"

#include <ctime>

namespace rave::cli {
namespace {

std::string local_time() {
  const std::time_t now = std::time(nullptr);
  std::tm fields{};
  ::localtime_r(&now, &fields);
  char text[32] = {};
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &fields);
  return text;
}

}  // namespace

Result<RunFolder> RunFolder::create(const std::filesystem::path& given, std::string_view scenario) {
  std::error_code error;
  RunFolder folder;
  if (!given.empty()) {
    folder.path_ = given;
    folder.is_new_ = std::filesystem::create_directories(given, error);
    if (error) {
      return fail(ErrorCode::kIo, "cannot create the folder `{}`: {}", given.string(),
                  error.message());
    }
    return folder;
  }
  std::filesystem::create_directories("runs", error);
  const std::string stem = fmt::format("runs/{}-{}", local_time(), scenario);
  for (int number = 1; !error && !folder.is_new_; ++number) {
    folder.path_ = number == 1 ? stem : fmt::format("{}-{}", stem, number);
    folder.is_new_ = std::filesystem::create_directory(folder.path_, error);
  }
  if (error) {
    return fail(ErrorCode::kIo, "cannot create the folder `{}`: {}; choose another with --output",
                stem, error.message());
  }
  return folder;
}

void RunFolder::discard() const {
  std::error_code ignored;
  if (is_new_) std::filesystem::remove_all(path_, ignored);
}

}  // namespace rave::cli
