#include "experiment/look.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/error.hpp"
#include "support/mistake.hpp"

namespace {

using recoil::ImportFormat;
using recoil::ImportRequest;
using testing::AllOf;
using testing::HasSubstr;

ImportRequest request_of(const std::string& text, const std::vector<std::string>& map = {}) {
  ImportRequest request;
  request.file = "table.csv";
  request.text = text;
  request.map = map;
  return request;
}

TEST(FileLook, FindsTheFormatThatTheColumnsFit) {
  const std::vector<std::pair<std::string, ImportFormat>> files = {
      {"V [m/s],e\n2,0.5\n3,0.6\n", ImportFormat::csv},
      {"incident velocity (cm/s);rebound velocity (cm/s)\n2,5;1,5\n3,5;2,5\n", ImportFormat::csv},
      {"speed before (cm/s),speed after (cm/s)\n30,24\n60,47\n", ImportFormat::csv},
      {"drop (cm),rebound (cm)\n30,24\n60,47\n", ImportFormat::heights},
      {"t (s),y (m)\n0,1\n0.1,0.95\n0.2,0.8\n0.3,0.56\n", ImportFormat::track},
      {"frame,pixel\n0,100\n1,110\n2,125\n3,150\n", ImportFormat::track},
      {"interval (s)\n0.5\n0.45\n0.41\n", ImportFormat::intervals},
      {"drop_height (cm),rest_time (s)\n30,5.1\n60,7.2\n", ImportFormat::rest},
      {"bounces,block_time (s)\n5,2.1\n5,1.4\n", ImportFormat::blocks},
      {"top (cm)\n60\n47\n37\n", ImportFormat::tops},
      {"a,\nX,Y\n2,0.5\n3,0.62\n", ImportFormat::webplotdigitizer}};
  for (const auto& [text, format] : files) {
    EXPECT_EQ(recoil::format_of(request_of(text)), format) << text;
  }
  EXPECT_EQ(recoil::format_of(
                request_of("x,y\n2,0.5\n3,0.6\n", {"incident_velocity=x:m/s", "restitution=y"})),
            ImportFormat::csv);
}

TEST(FileLook, NamesNoFormatWhereNoneOrSeveralFit) {
  for (const std::string text :
       {"x,y\n2,0.5\n3,0.6\n", "2,0.5\n3,0.6\n",
        "drop_height (cm),rebound_height (cm),rest_time (s)\n30,24,5.1\n"}) {
    EXPECT_THROW(recoil::format_of(request_of(text)), recoil::InputError) << text;
  }
}

TEST(FileLook, SuggestsTheQuantitiesOfSpeedsAndOfHeights) {
  try {
    recoil::format_of(request_of("x,y\n2,0.5\n3,0.6\n"));
    FAIL();
  } catch (const recoil::InputError& error) {
    for (const char* quantity : {"restitution", "rebound_velocity", "rebound_height"}) {
      EXPECT_NE(error.suggestion().find(quantity), std::string::npos) << quantity;
    }
  }
}

// What is mapped says the format: of the others, none can be meant.
TEST(FileLook, ReportsAMistakeInTheMapItself) {
  const std::string text = "speed before (cm/s),speed away (cm/s)\n30,24\n60,47\n";
  const auto refusal = [&](const std::string& map) {
    return support::message_of([&] { recoil::format_of(request_of(text, {map})); });
  };
  EXPECT_THAT(refusal("rebound_velocity=speed awy (cm/s)"),
              AllOf(HasSubstr("table.csv:1:1: no column is called 'speed awy (cm/s)'"),
                    HasSubstr("did you mean 'speed away (cm/s)'?")));
  EXPECT_THAT(refusal("velocity=speed away (cm/s)"),
              AllOf(HasSubstr("unknown quantity 'velocity'"), HasSubstr("'incident_velocity'")));
  EXPECT_THAT(refusal("speed away (cm/s)"), HasSubstr("not of the form quantity=column:unit"));
}

TEST(FileLook, ReportsAMistakeInARowAtItsPlace) {
  try {
    recoil::format_of(request_of("drop (cm),rebound (cm)\n30,24\n60,4O\n"));
    FAIL();
  } catch (const recoil::InputError& error) {
    EXPECT_EQ(error.where().line, 3);
    EXPECT_EQ(error.where().column, 4);
  }
}

TEST(FileLook, SaysWhatIsMissing) {
  using Words = std::vector<std::string>;
  EXPECT_EQ(recoil::look_at(request_of("V [m/s],e\n2,0.5\n3,0.6\n")).missing,
            (Words{"--diameter", "--particle", "--surface", "--provenance"}));
  ImportRequest known = request_of("V [m/s],e,d [um]\n2,0.5,5\n3,0.6,5\n");
  known.particle = "polystyrene";
  known.surface = "silicon";
  known.provenance = recoil::Provenance::measured;
  const recoil::FileLook look = recoil::look_at(known);
  EXPECT_EQ(look.missing, Words());
  EXPECT_EQ(look.points, 2U);
}

}  // namespace
