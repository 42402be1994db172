// SPDX-License-Identifier: Apache-2.0
#include "commands/edit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ranges>
#include <string_view>
#include <vector>

#include "asked_run.hpp"
#include "error_text.hpp"
#include "rave/base/number.hpp"

namespace rave::cli {
namespace {

/// The numbers in a word, between marks; none if it is anything else.
std::vector<double> numbers_in(std::string_view word, char mark) {
  std::vector<double> numbers;
  for (const auto part : std::views::split(word, mark)) {
    const auto number = number_of<double>({part.begin(), part.end()});
    if (!number) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

tl::unexpected<Error> wrong(std::string_view option, const std::string& found,
                            std::string_view expected) {
  return fail(ErrorCode::kInvalidArgument, "`{}`: found `{}`, expected {}", option, found,
              expected);
}

template <class Entry>
Status take_place(const EditCommand& options, Entry& entry) {
  const std::vector<double> at = numbers_in(options.at, ',');
  if (at.size() != 2 && at.size() != 3) {
    return wrong("--at", options.at, "X,Y or X,Y,DEG, such as 1,2.5,30");
  }
  entry.x_m = at[0];
  entry.y_m = at[1];
  if (at.size() == 3) entry.yaw_deg = at[2];
  return {};
}

Status take_corners(const EditCommand& options, config::Outline& outline) {
  auto& polygon_m = outline.polygon_m.emplace();
  for (const auto word : std::views::split(std::string_view(options.corners), ' ')) {
    if (word.empty()) continue;
    const std::vector<double> corner = numbers_in({word.begin(), word.end()}, ',');
    if (corner.size() != 2) {
      return wrong("--corners", options.corners, "places such as \"0,0 1,0 0.5,1\"");
    }
    polygon_m.push_back({corner[0], corner[1]});
  }
  return {};
}

Status take_outline(const EditCommand& options, config::Outline& outline) {
  if (options.shape == "polygon") return take_corners(options, outline);
  const bool is_box = options.shape == "box";
  const std::vector<double> size = numbers_in(options.size, 'x');
  if (size.size() != (is_box ? 2 : 1)) {
    return wrong("--size", options.size,
                 is_box ? "length and width of the box in metres, such as 0.5x0.3"
                        : "the radius of the disc in metres, such as 0.25");
  }
  if (is_box) {
    outline.box_m = {size[0], size[1]};
  } else {
    outline.disc_radius_m = size[0];
  }
  return {};
}

Result<config::ObstacleFile> obstacle_of(const EditCommand& options) {
  config::ObstacleFile obstacle;
  obstacle.name = options.name;
  RAVE_TRY(take_outline(options, obstacle.outline));
  RAVE_TRY(take_place(options, obstacle));
  if (!options.height.empty()) {
    const std::vector<double> height = numbers_in(options.height, ',');
    if (height.size() != 2) return wrong("--height", options.height, "LOW,HIGH, such as 0,0.8");
    obstacle.z_m = {height[0], height[1]};
  }
  if (options.layer == "mapped_real") obstacle.layer = config::ObstacleLayer::kMappedReal;
  if (!options.colour.empty()) obstacle.colour = options.colour;
  obstacle.barcode = options.barcode;
  return obstacle;
}

Result<control::Request> request_of(const EditCommand& options) {
  if (options.what == EditCommand::What::kList) {
    return control::request_of({request::ListObstacles()});
  }
  config::ObstacleEdit edit;
  if (options.what == EditCommand::What::kRemove) {
    edit.remove_obstacle = options.name;
  } else if (options.what == EditCommand::What::kMove) {
    edit.move_obstacle.emplace().name = options.name;
    RAVE_TRY(take_place(options, *edit.move_obstacle));
  } else {
    RAVE_TRY_ASSIGN(edit.add_obstacle, obstacle_of(options));
  }
  return control::request_of({request::Edit{std::move(edit)}});
}

}  // namespace

Result<int> edit_world(const EditCommand& options) {
  RAVE_TRY_ASSIGN(const auto request, request_of(options));
  RAVE_TRY_ASSIGN(const auto run, AskedRun::find(options.run, options.bus));
  const auto asked = std::chrono::steady_clock::now();
  RAVE_TRY_ASSIGN(const auto answer, run.ask(request));
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - asked;
  if (!answer.good) return refused(run, answer.text);
  const std::string done = options.what == EditCommand::What::kList
                               ? ""
                               : fmt::format(" ({:.1f} ms after the request)", took.count());
  put(stdout, fmt::format("{}: {}{}\n", run.name(), answer.text, done));
  return kGood;
}

}  // namespace rave::cli
