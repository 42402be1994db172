// SPDX-License-Identifier: Apache-2.0
#include "rave/config/input_files.hpp"

#include <algorithm>
#include <utility>

#include "rave/base/file.hpp"

namespace rave::config {
namespace {

std::string name_of(const std::filesystem::path& path) {
  std::error_code error;
  // The current folder may not exist any more.
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  return (error ? path : whole).lexically_normal().string();
}

}  // namespace

void InputFiles::add(const std::filesystem::path& path, Content content) {
  all_.try_emplace(name_of(path), std::move(content));
}

Result<InputFiles::Content> InputFiles::read(const std::filesystem::path& path,
                                             std::size_t max_bytes) const {
  const auto found = all_.find(name_of(path));
  if (found != all_.end()) return found->second;
  RAVE_TRY_ASSIGN(std::string text, rave::read_file(path, max_bytes));
  return std::make_shared<const std::string>(std::move(text));
}

bool InputFiles::operator==(const InputFiles& other) const {
  return std::ranges::equal(all_, other.all_, [](const auto& a, const auto& b) {
    return a.first == b.first && *a.second == *b.second;
  });
}

}  // namespace rave::config
