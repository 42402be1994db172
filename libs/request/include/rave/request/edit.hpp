// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "rave/codec/codec_base.hpp"
#include "rave/config/world_file.hpp"

namespace rave::request {

/// Adds, moves or removes an obstacle.
struct Edit {
  static constexpr std::string_view kName = "edit";
  config::ObstacleEdit edit{};
  friend bool operator==(const Edit&, const Edit&) = default;
};

/// Lists the obstacles; changes nothing.
struct ListObstacles {
  static constexpr std::string_view kName = "list";
  friend bool operator==(const ListObstacles&, const ListObstacles&) = default;
};

}  // namespace rave::request

/// The edit is described with the files.
template <>
struct rave::codec::Codec<rave::request::Edit> {
  static void read(const ReadContext& context, const RawNode& node, request::Edit& value);
  static RawNode write(const request::Edit& value);
  static RawNode schema(const FieldOptions& options);
  static std::string expectation(const FieldOptions& options);
};
