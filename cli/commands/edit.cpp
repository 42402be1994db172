// SPDX-License-Identifier: Apache-2.0
#include "commands/edit.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <chrono>
#include <vector>

#include "asked_run.hpp"
#include "error_text.hpp"

namespace rave::cli {
namespace {

using What = EditCommand::What;

/// The numbers in a word, between marks; none if it is anything else.
std::vector<double> numbers_in(std::string_view word, char mark) {
  std::vector<double> numbers;
  while (true) {
    const std::string_view part = word.substr(0, word.find(mark));
    double number = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
    if (error != std::errc{} || end != part.data() + part.size()) return {};
    numbers.push_back(number);
    if (part.size() == word.size()) return numbers;
    word.remove_prefix(part.size() + 1);
  }
}

tl::unexpected<Error> wrong(std::string_view option, const std::string& found,
                            std::string_view expected) {
  return fail(ErrorCode::kInvalidArgument, "`{}`: found `{}`, expected {}", option, found,
              expected);
}

/// In quotes, as YAML and JSON have them.
std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + "\"";
}

Result<std::string> place_yaml(const EditCommand& options) {
  const std::vector<double> at = numbers_in(options.at, ',');
  if (at.size() != 2 && at.size() != 3) {
    return wrong("--at", options.at, "X,Y or X,Y,DEG, such as 1,2.5,30");
  }
  return fmt::format("x_m: {}, y_m: {}, yaw_deg: {}", at[0], at[1], at.size() == 3 ? at[2] : 0.0);
}

Result<std::string> corners_yaml(const EditCommand& options) {
  std::vector<std::string> corners;
  std::string_view rest = options.corners;
  while (!rest.empty()) {
    const std::string_view word = rest.substr(0, rest.find(' '));
    rest.remove_prefix(std::min(word.size() + 1, rest.size()));
    if (word.empty()) continue;
    const std::vector<double> corner = numbers_in(word, ',');
    if (corner.size() != 2) {
      return wrong("--corners", options.corners, "places such as \"0,0 1,0 0.5,1\"");
    }
    corners.push_back(fmt::format("[{}, {}]", corner[0], corner[1]));
  }
  return fmt::format("polygon_m: [{}]", fmt::join(corners, ", "));
}

Result<std::string> outline_yaml(const EditCommand& options) {
  if (options.shape == "polygon") return corners_yaml(options);
  const bool is_box = options.shape == "box";
  const std::vector<double> size = numbers_in(options.size, 'x');
  if (is_box && size.size() == 2) return fmt::format("box_m: [{}, {}]", size[0], size[1]);
  if (!is_box && size.size() == 1) return fmt::format("disc_radius_m: {}", size[0]);
  return wrong("--size", options.size,
               is_box ? "length and width of the box in metres, such as 0.5x0.3"
                      : "the radius of the disc in metres, such as 0.25");
}

Result<control::Request> request_of(const EditCommand& options) {
  control::Request request;
  switch (options.what) {
    case What::kList:
      request.what = control::Request::What::kList;
      return request;
    case What::kRemove:
      request.what = control::Request::What::kRemove;
      request.key = options.name;
      return request;
    case What::kMove: {
      request.what = control::Request::What::kMove;
      RAVE_TRY_ASSIGN(const std::string place, place_yaml(options));
      // YAML, so that the run checks it with the reader of world files.
      request.value = fmt::format("{{name: {}, {}}}", in_quotes(options.name), place);
      return request;
    }
    case What::kAdd:
      break;
  }
  request.what = control::Request::What::kAdd;
  RAVE_TRY_ASSIGN(request.value, obstacle_yaml(options));
  return request;
}

}  // namespace

Result<std::string> obstacle_yaml(const EditCommand& options) {
  RAVE_TRY_ASSIGN(const std::string outline, outline_yaml(options));
  RAVE_TRY_ASSIGN(const std::string place, place_yaml(options));
  std::string yaml = fmt::format("{{name: {}, {}, {}", in_quotes(options.name), outline, place);
  if (!options.height.empty()) {
    const std::vector<double> height = numbers_in(options.height, ',');
    if (height.size() != 2) return wrong("--height", options.height, "LOW,HIGH, such as 0,0.8");
    yaml += fmt::format(", z_m: [{}, {}]", height[0], height[1]);
  }
  if (!options.layer.empty()) yaml += ", layer: " + in_quotes(options.layer);
  if (!options.colour.empty()) yaml += ", colour: " + in_quotes(options.colour);
  if (options.barcode) yaml += fmt::format(", barcode: {}", *options.barcode);
  return yaml + "}";
}

int edit_world(const EditCommand& options) {
  const auto request = request_of(options);
  if (!request) return complain(request.error());
  const auto run = AskedRun::find(options.run, options.bus);
  if (!run) return complain(run.error());
  const auto asked = std::chrono::steady_clock::now();
  const auto answer = run->ask(*request);
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - asked;
  if (!answer) return complain(answer.error());
  if (!answer->good) {
    complain({ErrorCode::kState, fmt::format("{}: {}", run->name(), answer->text), {}});
    return kNotGood;
  }
  const std::string done = options.what == What::kList
                               ? ""
                               : fmt::format(" ({:.1f} ms after the request)", took.count());
  put(stdout, fmt::format("{}: {}{}\n", run->name(), answer->text, done));
  return kGood;
}

}  // namespace rave::cli
