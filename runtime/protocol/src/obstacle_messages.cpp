// SPDX-License-Identifier: Apache-2.0
#include "rave/protocol/obstacle_messages.hpp"

#include <bit>
#include <cstdint>

#include "rave/bus/sequence.hpp"
#include "rave/config/world_file.hpp"

namespace rave::lock_step {
namespace {

using bus::elements;
using Kind = sim::ObstacleChange::Kind;

static_assert(ConvexPolygon::kMaxVertices == 64 && sim::ObstacleChange::kMostShapes == 64);

tl::unexpected<Error> too_long(std::string_view what, const sim::ObstacleChange& change) {
  return fail(ErrorCode::kInvalidArgument,
              "{} of obstacle `{}` is too long to be sent to another process", what, change.name);
}

/// Refers to the last `count` values of a vector, which must not grow afterwards.
template <class Sequence>
void lend_last(Sequence& sequence, std::vector<double>& values, std::size_t count) {
  sequence._buffer = values.data() + (values.size() - count);
  sequence._length = static_cast<std::uint32_t>(count);
  sequence._maximum = sequence._length;
  sequence._release = false;
}

bool same_bits(double a, double b) noexcept {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The polygon must be exactly what was sent: an additional or missing corner, or another first
/// corner, would be another world.
Result<ConvexPolygon> read_polygon(const rave_wire_BodyShape& wire) {
  const auto x = elements(wire.x_m);
  const auto y = elements(wire.y_m);
  std::vector<Vec2> corners;
  for (std::size_t i = 0; i < x.size(); ++i) corners.push_back({x[i], y[i]});
  RAVE_TRY_ASSIGN(ConvexPolygon polygon, ConvexPolygon::make(corners));
  // make() drops corners on a straight line and may reverse the sense of rotation, which is right
  // for files. Here all processes must have the same bits, because the run hash and contacts depend
  // on them.
  bool same = polygon.size() == corners.size();
  for (std::size_t i = 0; same && i < corners.size(); ++i) {
    const Vec2 made = polygon.vertices()[i];
    same = same_bits(made.x, corners[i].x) && same_bits(made.y, corners[i].y);
  }
  if (same) return polygon;
  return fail(
      ErrorCode::kInvalidArgument,
      "its corners are not those of a polygon that is strictly convex and counterclockwise");
}

Result<world::Shape> read_shape(const rave_wire_BodyShape& wire) {
  world::Shape shape;
  shape.z0_m = wire.z_min_m;
  shape.z1_m = wire.z_max_m;
  if (wire.kind == rave_wire_SHAPE_DISC) {
    shape.kind = world::ShapeKind::kDisc;
    shape.centre = {elements(wire.x_m)[0], elements(wire.y_m)[0]};
    shape.radius_m = wire.radius_m;
    return shape;
  }
  shape.kind = world::ShapeKind::kPolygon;
  RAVE_TRY_ASSIGN(shape.polygon, read_polygon(wire));
  return shape;
}

Status read_body(const rave_wire_ObstacleChange& wire, world::Body& body) {
  body.name = wire.name;
  body.layer =
      wire.layer == rave_wire_LAYER_MAPPED_REAL ? Layer::kMappedReal : Layer::kVirtualObstacles;
  if (wire.has_code) body.code = wire.code;
  body.code_z0_m = wire.code_z_min_m;
  body.code_z1_m = wire.code_z_max_m;
  body.colour = wire.colour;
  const auto shapes = elements(wire.shapes);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    auto shape = read_shape(shapes[i]);
    if (!shape) {
      return fail(ErrorCode::kInvalidArgument, "obstacle `{}`, shapes[{}]: {}", body.name, i,
                  shape.error().message);
    }
    body.shapes.push_back(*std::move(shape));
  }
  return {};
}

void put_corners(const world::Shape& shape, std::vector<double>& x_m, std::vector<double>& y_m,
                 rave_wire_BodyShape& wire) {
  if (shape.kind == world::ShapeKind::kDisc) {
    x_m.push_back(shape.centre.x);
    y_m.push_back(shape.centre.y);
  }
  for (const Vec2 corner : shape.vertices()) {
    x_m.push_back(corner.x);
    y_m.push_back(corner.y);
  }
  const std::size_t count = shape.kind == world::ShapeKind::kDisc ? 1 : shape.vertices().size();
  lend_last(wire.x_m, x_m, count);
  lend_last(wire.y_m, y_m, count);
}

}  // namespace

Status ObstacleParts::put_body(const sim::ObstacleChange& change, rave_wire_ObstacleChange& wire) {
  const world::Body& body = change.body;
  wire.layer =
      body.layer == Layer::kMappedReal ? rave_wire_LAYER_MAPPED_REAL : rave_wire_LAYER_VIRTUAL;
  wire.has_code = body.code.has_value();
  wire.code = body.code.value_or(0);
  wire.code_z_min_m = body.code_z0_m;
  wire.code_z_max_m = body.code_z1_m;
  if (!bus::put_text(wire.colour, body.colour)) return too_long("the colour", change);
  if (body.shapes.size() > sim::ObstacleChange::kMostShapes) return too_long("the body", change);
  // The message borrows its arrays from here, so the capacity is reserved first: growing would move
  // what the pieces before refer to.
  Body& mine = bodies_.emplace_back();
  std::size_t corners = 0;
  for (const world::Shape& shape : body.shapes) corners += shape.vertices().size() + 1;
  mine.x_m.reserve(corners);
  mine.y_m.reserve(corners);
  for (const world::Shape& shape : body.shapes) {
    rave_wire_BodyShape& piece = mine.shapes.emplace_back();
    const bool disc = shape.kind == world::ShapeKind::kDisc;
    piece.kind = disc ? rave_wire_SHAPE_DISC : rave_wire_SHAPE_POLYGON;
    if (disc) piece.radius_m = shape.radius_m;
    piece.z_min_m = shape.z0_m;
    piece.z_max_m = shape.z1_m;
    put_corners(shape, mine.x_m, mine.y_m, piece);
  }
  bus::borrow(wire.shapes, mine.shapes);
  return {};
}

Status ObstacleParts::fill(std::span<const sim::ObstacleChange> changes) {
  changes_.clear();
  bodies_.clear();
  if (changes.size() > rave_wire_kMaxObstacleChanges) {
    return fail(ErrorCode::kInvalidArgument, "{} changes of obstacles at once; expected at most {}",
                changes.size(), rave_wire_kMaxObstacleChanges);
  }
  changes_.resize(changes.size());
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const sim::ObstacleChange& change = changes[i];
    rave_wire_ObstacleChange& wire = changes_[i];
    wire.kind = static_cast<rave_wire_ObstacleChangeKind>(change.kind);
    wire.id = change.id.value();
    if (!bus::put_text(wire.name, change.name)) return too_long("the name", change);
    if (!bus::put_text(wire.asked, change.asked))
      return too_long("the text of the request", change);
    if (!bus::put_text(wire.author, change.by)) return too_long("the name of the author", change);
    if (change.kind == Kind::kRemove) continue;
    wire.x_m = change.X_WB.x;
    wire.y_m = change.X_WB.y;
    wire.yaw_rad = change.X_WB.yaw;
    if (change.kind == Kind::kAdd) RAVE_TRY(put_body(change, wire));
  }
  return {};
}

Result<sim::ObstacleChange> read_obstacle(const rave_wire_ObstacleChange& wire) {
  sim::ObstacleChange change;
  change.kind = static_cast<Kind>(wire.kind);
  change.id = BodyId(wire.id);
  change.name = wire.name;
  change.X_WB = {wire.x_m, wire.y_m, wire.yaw_rad};
  change.asked = wire.asked;
  change.by = wire.author;
  if (!change.asked.empty()) {
    const auto edit = config::read_edit(change.asked, "asked");
    if (!edit) {
      return fail(ErrorCode::kInvalidArgument, "obstacle `{}`, asked: {}", change.name,
                  edit.error().message);
    }
  }
  if (change.kind == Kind::kAdd) RAVE_TRY(read_body(wire, change.body));
  RAVE_TRY(sim::check_obstacle_change(change));
  return change;
}

std::size_t wire_bytes(const sim::ObstacleChange& change) noexcept {
  // An estimate from above for the limits of a step, not the exact size: 128 bytes of fixed fields
  // and padding, 64 per piece, two doubles per corner.
  std::size_t bytes = 128 + change.name.size() + change.asked.size() + change.body.colour.size();
  for (const world::Shape& shape : change.body.shapes) {
    bytes += 64 + 16 * (shape.vertices().size() + 1);
  }
  return bytes;
}

Status check_fits(const sim::ObstacleChange& change) {
  // Goes the way through the wire and back, so a change that another process would refuse is
  // refused before it is asked for.
  ObstacleParts parts;
  RAVE_TRY(parts.fill(std::span(&change, 1)));
  if (change.kind != Kind::kAdd) return {};
  world::Body body;
  return read_body(parts.changes().front(), body);
}

}  // namespace rave::lock_step
