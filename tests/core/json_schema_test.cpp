// The schema of a struct says what as_json writes of it.
#include "tables/json_schema.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>

namespace recoil {
namespace {

enum class Shade { red, green };

constexpr auto names_of_values(Shade) { return name_list("red", "green"); }

struct Marble {
  RECOIL_RESULT((double, mass, "mass", "kg"), (OrNull<Shade>, colour, "colour of the ball"))
};

using Ends = std::array<double, 2>;

struct Bag {
  RECOIL_RESULT((FormatVersion, format_version, "version"),
                (std::string, unit, "unit of the height", "", R"({"const": "m"})"),
                (std::uint64_t, seed, "seed"), (long, change, "change", "", R"({"minimum": null})"),
                (std::vector<Marble>, balls, "the balls"), (Named<bool>, open, "by name"),
                (OrAbsent<OrNull<Ends>>, range, "range", "1"),
                (OrReason<double>, height, "height", "its unit"), (OrNull<Marble>, lid, "the lid"))
};

TEST(JsonSchema, FollowsFromTheMembers) {
  const Json ball = Json::parse(R"({
    "type": "object",
    "properties": {
      "mass": {"type": "number", "description": "mass [kg]"},
      "colour": {"enum": ["red", "green", null], "description": "colour of the ball"}},
    "required": ["mass", "colour"],
    "additionalProperties": false})");
  Json expected = Json::parse(R"({
    "type": "object",
    "properties": {
      "format_version": {"const": 2, "description": "version"},
      "unit": {"type": "string", "const": "m", "description": "unit of the height"},
      "seed": {"type": "integer", "minimum": 0, "description": "seed"},
      "change": {"type": "integer", "description": "change"},
      "balls": {"type": "array", "items": null, "description": "the balls"},
      "open": {"type": "object", "additionalProperties": {"type": "boolean"},
               "description": "by name"},
      "range": {"type": ["array", "null"], "items": {"type": "number"}, "minItems": 2,
                "maxItems": 2, "description": "range [1]"},
      "height": {"type": ["number", "null"], "description": "height [its unit]"},
      "height_why": {"type": "string", "description": "the reason, if there is no value"},
      "lid": null},
    "required": ["format_version", "unit", "seed", "change", "balls", "open", "height", "lid"],
    "additionalProperties": false})");
  expected["properties"]["balls"]["items"] = ball;
  Json lid = ball;
  lid["type"] = {"object", "null"};
  lid["description"] = "the lid";
  expected["properties"]["lid"] = lid;
  EXPECT_EQ(schema_of<Bag>().dump(1), expected.dump(1));
}

TEST(JsonSchema, MembersAreWrittenAndRead) {
  Bag box;
  box.unit = "m";
  box.balls = {{.mass = 2.5, .colour = Shade::green}};
  box.height = {std::nullopt, "it was not measured"};
  const std::string text = R"({"format_version":2,"unit":"m","seed":0,"change":0,)"
                           R"("balls":[{"mass":2.5,"colour":"green"}],"open":{},"height":null,)"
                           R"("height_why":"it was not measured","lid":null})";
  EXPECT_EQ(as_json(box).dump(), text);
  EXPECT_EQ(as_json(value_from<Bag>(Json::parse(text))).dump(), text);
}

TEST(JsonSchema, AnotherFormatVersionIsAMismatch) {
  EXPECT_THROW(value_from<Bag>(Json::parse(R"({"format_version": 1})")), JsonMismatch);
}

}  // namespace
}  // namespace recoil
