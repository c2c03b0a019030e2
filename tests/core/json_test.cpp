// Structs that describe their members once: what is written is read back.
#include "core/json.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace recoil {
namespace {

enum class Colour { red, green };

constexpr auto names_of_values(Colour) { return name_list("red", "green"); }

struct Ball {
  std::string name;
  Colour colour = Colour::red;
  double diameter_um = NAN;
  std::optional<double> mass;
  RECOIL_FIELDS(name, colour, diameter_um, mass)
};

struct Box {
  int format_version = 1;
  std::uint64_t seed = 0;
  bool closed = false;
  std::vector<Ball> balls;
  Named<Ball> by_name;
  std::optional<std::array<double, 2>> range;
  std::vector<std::pair<std::string, double>> none;
  std::vector<std::tuple<int, double>> counts;
  OrAbsent<std::vector<bool>> flags;
  OrAbsent<double> never;
  OrReason<double> height;
  OrReason<double> depth;
  Json replicates;
  RECOIL_FIELDS(format_version, seed, closed, balls, by_name, range, none, counts, flags, never,
                height, depth, replicates)
};

Box full_box() {
  const Ball steel{"steel", Colour::green, 4.9, 1e-13};
  const Ball glass{"glass", Colour::red, 2.6, std::nullopt};
  Box box;
  box.seed = std::numeric_limits<std::uint64_t>::max();
  box.closed = true;
  box.balls = {steel, glass};
  box.by_name = {{"b", glass}, {"a", steel}};
  box.range = {0.1, 0.30000000000000004};
  box.counts = {{1, 0.5}, {2, -0.0}};
  box.flags.emplace({true, false});
  box.height = {std::nullopt, "it was not measured"};
  box.depth = {1.5, "this reason is not written"};
  box.replicates = "auto";
  return box;
}

TEST(JsonFields, WriteEveryMemberUnderItsName) {
  EXPECT_EQ(as_json(full_box()).dump(),
            R"({"format_version":1,"seed":18446744073709551615,"closed":true,)"
            R"("balls":[{"name":"steel","colour":"green","diameter_um":4.9,"mass":1e-13},)"
            R"({"name":"glass","colour":"red","diameter_um":2.6,"mass":null}],)"
            R"("by_name":{"b":{"name":"glass","colour":"red","diameter_um":2.6,"mass":null},)"
            R"("a":{"name":"steel","colour":"green","diameter_um":4.9,"mass":1e-13}},)"
            R"("range":[0.1,0.30000000000000004],"none":{},"counts":[[1,0.5],[2,0.0]],)"
            R"("flags":[true,false],"height":null,"height_why":"it was not measured",)"
            R"("depth":1.5,"replicates":"auto"})");
}

TEST(JsonFields, AreReadAsTheyWereWritten) {
  const Json written = as_json(full_box());
  const Box read = value_from<Box>(Json::parse(written.dump()));
  EXPECT_EQ(as_json(read).dump(), written.dump());
  EXPECT_EQ(read.balls[0].colour, Colour::green);
  EXPECT_EQ(read.height.why, "it was not measured");
  EXPECT_FALSE(read.never.has_value());
}

TEST(JsonFields, KeepWhatAFileOfAnotherVersionDoesNotHave) {
  const Ball read = value_from<Ball>(Json::parse(R"({"name": "glass", "unknown": [1]})"));
  EXPECT_EQ(read.name, "glass");
  EXPECT_TRUE(std::isnan(read.diameter_um));
}

TEST(JsonFields, WriteNumbersThatAreNotFiniteAsNullOrAsWords) {
  const std::vector<double> values = {INFINITY, -INFINITY, NAN, -0.0, 0.1};
  EXPECT_EQ(as_json(values).dump(), "[null,null,null,0.0,0.1]");
  const Json exact = as_json(values, NonFinite::word);
  EXPECT_EQ(exact.dump(), R"(["inf","-inf","nan",-0.0,0.1])");
  const auto read = value_from<std::vector<double>>(exact);
  EXPECT_EQ(read[0], INFINITY);
  EXPECT_EQ(read[1], -INFINITY);
  EXPECT_TRUE(std::isnan(read[2]));
  EXPECT_TRUE(std::signbit(read[3]));
}

TEST(JsonFields, NameThePlaceOfWhatCannotBeRead) {
  const auto message = [](const char* text) -> std::string {
    try {
      value_from<Box>(Json::parse(text));
    } catch (const JsonMismatch& mismatch) {
      return mismatch.what();
    }
    return {};
  };
  EXPECT_EQ(message(R"([1])"), "the value is [1], not an object");
  EXPECT_EQ(message(R"({"seed": 0.5})"), "'seed' is 0.5, not an integer");
  EXPECT_EQ(message(R"({"balls": [{}, {"colour": "blue"}]})"),
            R"('balls[1].colour' is "blue", not one of the known names)");
  EXPECT_EQ(message(R"({"by_name": {"a": {"mass": "1"}}})"),
            R"('by_name.a.mass' is "1", not a number)");
  EXPECT_EQ(message(R"({"range": [1]})"), "'range' is [1], not a list of the right length");
}

TEST(ParseJson, LimitsTheNestingOfWhatIsNoText) {
  const auto nested = [](int levels) {
    const auto count = static_cast<std::size_t>(levels);
    return R"({"key \" [[[": )" + std::string(count - 1, '[') + std::string(count - 1, ']') + "}";
  };
  EXPECT_TRUE(parse_json(nested(deepest_json)).is_object());
  EXPECT_TRUE(parse_json(nested(deepest_json + 1)).is_discarded());
  EXPECT_TRUE(parse_json(nested(1000000)).is_discarded());
  EXPECT_TRUE(parse_json("\"" + std::string(1000, '[') + "\"").is_string());
  EXPECT_TRUE(parse_json(R"("\\")").is_string());
  for (const char* text : {"", "[", "\"", "\"\\", "]", "{]", "nan"}) {
    EXPECT_TRUE(parse_json(text).is_discarded()) << text;
  }
}

TEST(JsonFields, TextIsValidWhateverTheBytesAre) {
  Ball ball;
  ball.name = "broken \xff\xfe\n";
  const std::string text = text_of(ball);
  EXPECT_EQ(text.back(), '\n');
  EXPECT_TRUE(Json::accept(text));
}

}  // namespace
}  // namespace recoil
