// SPDX-License-Identifier: Apache-2.0
#include "lua_values.hpp"

#include <string>
#include <type_traits>
#include <utility>

#include "rave/robot/reading_type.hpp"

namespace rave::lua {
namespace {

using script::Value;

void put(Value::Table& table, std::string_view key, Value value) {
  table.push_back({std::string(key), std::move(value)});
}

/// A list counts from 1.
void append(Value::Table& list, Value value) {
  const auto next = static_cast<std::int64_t>(list.size()) + 1;
  list.push_back({next, std::move(value)});
}

Value number_value(const ReadingField& field, const std::byte* record) {
  Value value;
  with_number(field, record, [&value](auto number) {
    if constexpr (std::is_integral_v<decltype(number)>) {
      value = static_cast<std::int64_t>(number);
    } else {
      value = static_cast<double>(number);
    }
  });
  return value;
}

Value record_value(const ReadingType& type, const std::byte* record) {
  Value::Table fields;
  for (const ReadingField& field : type.columns) {
    put(fields, field.name, number_value(field, record));
  }
  return fields;
}

}  // namespace

Value sample_value(ReadingKind kind, std::uint32_t count, const std::byte* records) {
  const ReadingType& type = reading_type(kind);
  if (type.shape == ReadingShape::kState) {
    return count == 0 ? Value() : record_value(type, records);
  }
  Value::Table list;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::byte* const record = records + std::size_t{i} * type.record_bytes;
    append(list, type.shape == ReadingShape::kSeries ? number_value(type.fields.front(), record)
                                                     : record_value(type, record));
  }
  return list;
}

Value order_value(const Order& order) {
  Value::Table table;
  put(table, "kind", std::string(to_string(order.kind)));
  put(table, "by", std::string(order.by));
  if (order.kind == OrderKind::kText) put(table, "text", std::string(order.text));
  if (order.kind == OrderKind::kGoal && !order.points_W.empty()) {
    put(table, "x", order.points_W.front().x);
    put(table, "y", order.points_W.front().y);
  }
  if (order.kind == OrderKind::kPath) {
    Value::Table points;
    for (const Vec2& point : order.points_W) {
      Value::Table one;
      put(one, "x", point.x);
      put(one, "y", point.y);
      append(points, std::move(one));
    }
    put(table, "points", std::move(points));
  }
  if (order.yaw_rad) put(table, "yaw", *order.yaw_rad);
  if (order.speed_mps > 0) put(table, "speed", order.speed_mps);
  return table;
}

Value pose_value(const PoseReading& pose) {
  Value::Table table;
  put(table, "x", pose.x_m);
  put(table, "y", pose.y_m);
  put(table, "yaw", pose.yaw_rad);
  return table;
}

Value message_value(const Message& message) {
  const auto* const text = reinterpret_cast<const char*>(message.bytes.data());
  Value::Table table;
  put(table, "from", std::int64_t{message.from});
  put(table, "text", std::string(text, message.bytes.size()));
  return table;
}

}  // namespace rave::lua
