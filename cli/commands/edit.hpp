// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bus_options.hpp"
#include "rave/base/result.hpp"

// Changes from one terminal to the world of a run in another.
namespace rave::cli {

/// `rave edit`.
struct EditCommand {
  enum class What : std::uint8_t { kAdd, kMove, kRemove, kList };
  What what = What::kList;
  std::string run;             ///< Empty: the only one.
  std::string name;            ///< Name of the obstacle.
  std::string shape;           ///< kAdd: `box`, `disc` or `polygon`.
  std::string at;              ///< kAdd and kMove: X,Y or X,Y,DEG.
  std::string size;            ///< kAdd: LxW of a box, the radius of a disc.
  std::string corners;         ///< kAdd: X,Y of each corner of a polygon, between spaces.
  std::string height;          ///< kAdd: LOW,HIGH; empty: as in files.
  std::string layer;           ///< kAdd; empty: as in files.
  std::string colour;          ///< kAdd: `#rrggbb`; empty: none.
  std::optional<int> barcode;  ///< kAdd.
  BusOptions bus;              ///< Where to look for a run that is not on this machine.
};

/// Prints what was done and how long the run took to do it. Returns 0; 1 if the run refuses; 2 for
/// bad input, or if there is no such run or it does not answer.
[[nodiscard]] Result<int> edit_world(const EditCommand& options);

}  // namespace rave::cli
