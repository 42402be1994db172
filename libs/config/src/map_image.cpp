// SPDX-License-Identifier: Apache-2.0
// Maps in the format of map_server of ROS: a YAML file that names an image.
#include "rave/config/map_image.hpp"

#include <algorithm>

#include "rave/base/named_path.hpp"
#include "rave/base/names.hpp"
#include "rave/config/fields.hpp"

namespace rave::config {
namespace {

enum class MapMode : std::uint8_t { kTrinary, kScale, kRaw };

constexpr auto enum_names(EnumTag<MapMode>) {
  return std::array{EnumName{MapMode::kTrinary, "trinary"}, EnumName{MapMode::kScale, "scale"},
                    EnumName{MapMode::kRaw, "raw"}};
}

/// `negate` is 0 or 1 in files of ROS; true and false are accepted too.
struct MapFlag {
  bool on = false;
};

struct MapServerFile {
  Located<std::string> image;
  double resolution_m = 0;
  std::array<double, 3> origin{};
  MapFlag negate;
  double occupied_thresh = 0;
  double free_thresh = 0;
  MapMode mode = MapMode::kTrinary;
};

}  // namespace

}  // namespace rave::config

template <>
struct rave::codec::Codec<rave::config::MapFlag> {
  using MapFlag = config::MapFlag;
  static void read(const ReadContext& context, const RawNode& node, MapFlag& value) {
    const auto number = node.as_int();
    if (const auto flag = node.as_bool()) {
      value.on = *flag;
    } else if (number == 0 || number == 1) {
      value.on = *number == 1;
    } else {
      context.wrong(node, expectation(context.options));
    }
  }
  static RawNode write(const MapFlag& value) { return RawNode::integer(value.on ? 1 : 0); }
  static RawNode schema(const FieldOptions&) { return RawNode::mapping(); }
  static std::string expectation(const FieldOptions&) { return "0, 1, false or true"; }
};

namespace rave::config {
namespace {

template <class V>
void describe(V& v, MapServerFile& c) {
  v.required("image", c.image, {.min_items = 1, .max_items = 4096});
  v.required("resolution", c.resolution_m,
             {.min = 0, .exclusive_min = true, .max = 1000, .unit = "m"});
  v.required("origin", c.origin, {.min = -1e7, .max = 1e7});
  v.required("negate", c.negate);
  v.required("occupied_thresh", c.occupied_thresh, {.min = 0, .max = 1});
  v.required("free_thresh", c.free_thresh, {.min = 0, .max = 1});
  v.field("mode", c.mode);
}

void validate(const MapServerFile& c, CheckContext& check) {
  if (c.free_thresh > c.occupied_thresh) {
    check.error("free_thresh", "`free_thresh`: found {}, expected at most `occupied_thresh` ({})",
                c.free_thresh, c.occupied_thresh);
  }
}

/// The state of a cell. Source: http://wiki.ros.org/map_server, "Value Interpretation".
CellState state_of(std::uint8_t shade, bool opaque, const MapServerFile& file) {
  // p: the probability that the cell is occupied. Dark is occupied unless negated.
  double p = file.negate.on ? shade / 255.0 : (255 - shade) / 255.0;
  // In this mode transparency means unknown.
  if (file.mode == MapMode::kScale && !opaque) return CellState::kUnknown;
  if (file.mode == MapMode::kRaw) {
    // Raw values are per cent, and all above 100 unknown.
    if (shade > 100) return CellState::kUnknown;
    p = shade / 100.0;
  }
  if (p > file.occupied_thresh) return CellState::kOccupied;
  return p < file.free_thresh ? CellState::kFree : CellState::kUnknown;
}

constexpr std::array<std::string_view, 7> kMapKeys = {
    "image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"};

/// Other programs put keys of their own into such files, which ROS ignores. One that is nearly a
/// key which is missing stays, and is refused as a typing error.
void leave_out_others(RawNode& tree) {
  if (!tree.is_mapping()) return;
  const std::vector<std::string_view> keys = tree.keys();
  for (const std::string& key : std::vector<std::string>(keys.begin(), keys.end())) {
    if (std::ranges::find(kMapKeys, key) != kMapKeys.end()) continue;
    const bool near = std::ranges::any_of(kMapKeys, [&](std::string_view known) {
      return tree.find(known) == nullptr && edit_distance(key, known) <= 1;
    });
    if (!near) tree.erase(key);
  }
}

Result<MapServerFile> read_map_yaml(std::string_view yaml, const std::filesystem::path& path) {
  return read_text<MapServerFile>(
      yaml, path.string(),
      [](RawNode& tree, Diagnostics& /*diagnostics*/) { leave_out_others(tree); });
}

std::filesystem::path image_path(const MapServerFile& file,
                                 const std::filesystem::path& yaml_path) {
  return named_path(yaml_path.parent_path(), file.image.value);
}

Result<InputFiles::Content> read_image(const std::filesystem::path& path, const InputFiles& files) {
  constexpr std::size_t kMaxImageBytes = std::size_t{512} << 20;
  return files.read(path, kMaxImageBytes);
}

}  // namespace

Result<GreyImage> decode_image(std::string_view bytes, std::string_view file_name) {
  if (bytes.starts_with("\x89PNG")) return decode_png(bytes, file_name);
  if (bytes.starts_with("P2") || bytes.starts_with("P5")) return decode_pgm(bytes, file_name);
  if (bytes.empty()) return fail(ErrorCode::kParse, "`{}`: the image file is empty", file_name);
  return fail(ErrorCode::kParse, "`{}`: neither a PGM (P2, P5) nor a PNG image", file_name);
}

Result<MapFiles> read_map_files(const std::filesystem::path& yaml_path, const InputFiles& files) {
  RAVE_TRY_ASSIGN(auto yaml, files.read(yaml_path, kMaxFileBytes));
  RAVE_TRY_ASSIGN(const MapServerFile file, read_map_yaml(*yaml, yaml_path));
  std::filesystem::path path = image_path(file, yaml_path);
  RAVE_TRY_ASSIGN(auto image, read_image(path, files));
  return MapFiles{std::move(yaml), std::move(path), std::move(image)};
}

Result<MapImage> read_map(const std::filesystem::path& yaml_path, const InputFiles& files) {
  RAVE_TRY_ASSIGN(const auto yaml, files.read(yaml_path, kMaxFileBytes));
  return read_map_text(*yaml, yaml_path, files);
}

Result<MapImage> read_map_text(std::string_view yaml, const std::filesystem::path& yaml_path,
                               const InputFiles& files) {
  RAVE_TRY_ASSIGN(const MapServerFile file, read_map_yaml(yaml, yaml_path));
  const std::filesystem::path path = image_path(file, yaml_path);
  const auto decode = [&]() -> Result<GreyImage> {
    RAVE_TRY_ASSIGN(const auto bytes, read_image(path, files));
    return decode_image(*bytes, path.string());
  };
  Result<GreyImage> image = decode();
  if (!image) {
    Error error = std::move(image).error();
    // The line that names the image: the image itself has no lines.
    error.where = file.image.where;
    return tl::unexpected<Error>(std::move(error));
  }
  MapImage map;
  map.width = image->width;
  map.height = image->height;
  map.resolution_m = file.resolution_m;
  map.origin_x_m = file.origin[0];
  map.origin_y_m = file.origin[1];
  map.origin_yaw_rad = file.origin[2];
  map.raw = file.mode == MapMode::kRaw;
  map.cells.reserve(image->shade.size());
  for (std::size_t i = 0; i < image->shade.size(); ++i) {
    map.cells.push_back(state_of(image->shade[i], image->opaque[i] != 0, file));
  }
  return map;
}

}  // namespace rave::config
