// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// A table of short cells that is made to fit.
namespace rave::watch {

enum class Tone : std::uint8_t { kPlain, kFaint, kGood, kCare, kBad };

struct Cell {
  std::string text{};
  Tone tone = Tone::kPlain;
};

struct Column {
  std::string heading;
  bool right = true;
  int weight = 0;  ///< The column of least weight is left out first.
};

struct Grid {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< As many cells as columns.
};

/// Text in the colour of a tone.
[[nodiscard]] std::string toned(std::string text, Tone tone, bool colour);

/// The grid as lines, heading first. Columns without any text are left out, then those of least
/// weight until the rest is no wider than `width`; the last one left is cut. `most_rows`: further
/// ones are counted in one line.
[[nodiscard]] std::vector<std::string> lines_of(const Grid& grid, std::size_t width,
                                                std::size_t most_rows, bool colour);

}  // namespace rave::watch
