// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "utias/dataset.hpp"

namespace rave::utias {

inline constexpr std::int64_t kMillisecond_ns = 1'000'000;
inline constexpr std::int64_t kSecond_ns = 1'000'000'000;

inline std::filesystem::path stretch_folder(const std::string& name) {
  return std::filesystem::path(RAVE_SOURCE_DIR) / "data" / "utias-mrclam6" / name;
}

/// A shipped stretch; the test fails and an empty set is given if it does not load.
inline Dataset recorded(const std::string& name, const LoadOptions& options = {}) {
  auto data = load(stretch_folder(name), options);
  if (data) return std::move(*data);
  ADD_FAILURE() << data.error().text();
  return {};
}

}  // namespace rave::utias
