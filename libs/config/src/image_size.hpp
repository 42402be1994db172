// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "rave/config/map_image.hpp"

namespace rave::config {

/// Refuses images without pixels or with more than kMaxMapPixels.
[[nodiscard]] inline Status check_image_size(std::uint64_t width, std::uint64_t height,
                                             std::string_view file_name) {
  if (width == 0 || height == 0) {
    return fail(ErrorCode::kParse, "`{}`: the image has no pixels ({} x {})", file_name, width,
                height);
  }
  if (width > kMaxMapPixels || height > kMaxMapPixels / width) {
    return fail(ErrorCode::kParse, "`{}`: the image is too large ({} x {}; at most {} pixels)",
                file_name, width, height, kMaxMapPixels);
  }
  return {};
}

}  // namespace rave::config
