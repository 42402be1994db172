// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "rave/config/map_image.hpp"

namespace {

using rave::config::CellState;

/// The rectangles cover as many cells as are occupied.
void check_cover(const rave::config::GreyImage& image) {
  rave::config::MapImage map;
  map.width = image.width;
  map.height = image.height;
  map.resolution_m = 1;
  for (const std::uint8_t shade : image.shade) {
    map.cells.push_back(shade < 128 ? CellState::kOccupied : CellState::kFree);
  }
  std::ptrdiff_t area = 0;
  for (const auto& r : rave::config::cell_rectangles_of(map)) {
    area += std::ptrdiff_t{r.width} * r.height;
  }
  if (area != std::count(map.cells.begin(), map.cells.end(), CellState::kOccupied)) std::abort();
}

void check_image(const rave::Result<rave::config::GreyImage>& image) {
  if (!image) return;
  const std::size_t pixels =
      static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height);
  if (pixels == 0 || image->shade.size() != pixels || image->opaque.size() != pixels) std::abort();
  if (pixels <= 65536) check_cover(*image);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  check_image(rave::config::decode_pgm(bytes, "fuzz.pgm"));
  check_image(rave::config::decode_png(bytes, "fuzz.png"));
  // The folder does not exist, so that no file is opened.
  const auto map = rave::config::read_map_text(bytes, "no-such-folder/fuzz.yaml");
  if (!map && map.error().message.empty()) std::abort();
  return 0;
}
