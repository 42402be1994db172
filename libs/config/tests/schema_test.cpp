// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "sample_config.hpp"

namespace rave::config {
namespace {

TEST(Schema, TextOfASmallStruct) {
  EXPECT_EQ(codec::json_schema(Codec<std::vector<std::optional<double>>>::schema({}), "T", "i"),
            "{\n"
            "  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n"
            "  \"$id\": \"i\",\n"
            "  \"title\": \"T\",\n"
            "  \"type\": \"array\",\n"
            "  \"items\": {\n"
            "    \"anyOf\": [\n"
            "      {\n"
            "        \"type\": \"number\"\n"
            "      },\n"
            "      {\n"
            "        \"type\": \"null\"\n"
            "      }\n"
            "    ]\n"
            "  }\n"
            "}\n");
}

TEST(Schema, SaysWhatTheDescriptionSays) {
  const auto schema = nlohmann::json::parse(
      codec::json_schema(Codec<sample::Laser>::schema({}), "Laser", "laser.json"));
  EXPECT_EQ(schema["type"], "object");
  EXPECT_EQ(schema["additionalProperties"], false);
  EXPECT_EQ(schema["required"], nlohmann::json::array({"frame"}));
  const auto& fields = schema["properties"];
  EXPECT_EQ(fields.size(), 16U);
  EXPECT_EQ(fields["range_m"], nlohmann::json::parse(R"({"description": "[m] Farthest reading.",
      "type": "number", "exclusiveMinimum": 0, "default": 8})"));
  EXPECT_EQ(fields["rays"], nlohmann::json::parse(R"({"description": "Beams in one sweep.",
      "type": "integer", "minimum": 1, "maximum": 100000, "default": 180})"));
  EXPECT_EQ(fields["role"]["enum"], nlohmann::json::array({"observer", "commander", "super_user"}));
  EXPECT_EQ(fields["role"]["default"], "observer");
  EXPECT_EQ(fields["frame"].count("default"), 0U);
  EXPECT_EQ(fields["frame"]["minLength"], 1);
  EXPECT_EQ(fields["seed"]["minimum"], 0);
  EXPECT_EQ(fields["params"]["default"], nullptr);
  const auto& mount = fields["mounts"]["items"];
  EXPECT_EQ(mount["required"], nlohmann::json::array({"at_m"}));
  EXPECT_EQ(mount["properties"]["at_m"]["minItems"], 2);
  EXPECT_EQ(mount["properties"]["at_m"]["maxItems"], 2);
  EXPECT_EQ(fields["mounts"]["maxItems"], 4);
  EXPECT_EQ(fields["named"]["additionalProperties"]["required"], mount["required"]);
}

}  // namespace
}  // namespace rave::config
