// Any table with a column map, what is asked for, and what is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "data/material_table.hpp"
#include "import_folder.hpp"
#include "support/command.hpp"
#include "support/workplace.hpp"

namespace {

using import_folder::complaint;
using import_folder::Place;
using recoil::Dataset;
using recoil::ImportFormat;
using testing::AllOf;
using testing::HasSubstr;

const char* const kTable =
    "run,Vi,Vr,D,remark\n"
    "mon,200,100,4.9,fine\n"
    "\"tue, late\",500,400,2.5,wet\n";
const char* const kMap =
    "incident_velocity=Vi:cm/s,rebound_velocity=Vr:cm/s,diameter=D:um,series=run";

TEST(Table, ColumnsByTheirMap) {
  const Place place;
  auto request = place.request(kTable, ImportFormat::csv);
  request.map = {kMap};
  const auto result = recoil::import_points(request);
  const Dataset& made = result.dataset;
  ASSERT_EQ(made.points.size(), 2U);
  EXPECT_EQ(made.series[1], "tue, late");
  EXPECT_DOUBLE_EQ(made.points[0].incident_velocity, 2.0);
  EXPECT_DOUBLE_EQ(made.points[0].restitution, 0.5);
  EXPECT_DOUBLE_EQ(made.points[1].diameter, 2.5e-6);
  const auto noted = [&](recoil::ImportRemark remark) {
    return std::find_if(result.notes.begin(), result.notes.end(),
                        [&](const auto& note) { return note.remark == remark; });
  };
  const auto unused = noted(recoil::ImportRemark::columns_not_used);
  ASSERT_NE(unused, result.notes.end());
  EXPECT_EQ(unused->names, std::vector<std::string>{"remark"});
  EXPECT_NE(noted(recoil::ImportRemark::diameter_not_used), result.notes.end());
  EXPECT_EQ(made.sources, std::vector<std::string>{"A test"});
  EXPECT_EQ(made.system.particle.name, "polystyrene");
  EXPECT_DOUBLE_EQ(made.system.particle.density, 1050.0);
}

TEST(Table, SettingsAndConditionsComeAlong) {
  const Place place;
  auto request = place.request("day,p,V,e\nmon,1000,2,0.5\nmon,,3,0.6\n\"tue, late\",10,4,0.7\n",
                               ImportFormat::csv);
  request.map = {"setting=day,ambient_pressure=p:hPa,incident_velocity=V:m/s,restitution=e:1"};
  recoil::import_points(request);
  const Dataset made = recoil::load_dataset(request.into);  // as written
  ASSERT_EQ(made.points.size(), 3U);
  EXPECT_EQ(made.points[1].setting, "mon");
  EXPECT_EQ(made.points[2].setting, "tue, late");
  const auto pressure = [&](std::size_t i) {
    return recoil::conditions_of(made, made.points[i].series)
        .of(recoil::Condition::ambient_pressure);
  };
  EXPECT_DOUBLE_EQ(*pressure(0), 1e5);
  EXPECT_EQ(pressure(1), std::nullopt);
  EXPECT_DOUBLE_EQ(*pressure(2), 1e3);
}

TEST(Table, AnAngleOfIncidenceIsKnownByItsUsualNames) {
  const Place place;
  int number = 0;
  for (const char* name : {"incidence_angle [deg]", "angle (deg)", "Incidence angle (°)",
                           "angle of incidence [deg]", "incident angle [deg]"}) {
    SCOPED_TRACE(name);
    auto request = place.request(
        std::string("V,") + name + ",Vr,tangential restitution\n2,60,0.8,0.9\n", ImportFormat::csv);
    request.map = {"incident_velocity=V:m/s,rebound_velocity=Vr:m/s"};
    request.into = place.folder() / std::to_string(number++);
    request.scatter = "10%";
    recoil::import_points(request);
    const Dataset made = recoil::load_dataset(request.into);    // as written
    EXPECT_NEAR(made.points[0].incident_velocity, 1.0, 1e-12);  // 2 cos(60 deg)
    EXPECT_NEAR(made.points[0].restitution, 0.8, 1e-12);
    EXPECT_NEAR(made.points[0].restitution_sd.value(), 0.08, 1e-12);
    EXPECT_EQ(made.points[0].tangential_restitution, 0.9);
  }
  EXPECT_THAT(place.read("0/points.csv"), HasSubstr(",60,0.9"));  // in degrees
}

TEST(Table, UsualNamesNeedNoMap) {
  const Place place;
  int number = 0;
  for (const char* text :
       {"V [m/s],e,d [um]\n2,0.8,5\n", "Vi (cm/s);Vr (cm/s);Diameter (um)\n200;160;5\n",
        "Impact velocity [m/s],COR,particle diameter [mm]\n2,0.8,0.005\n",
        "e\tV\tD\n\tm/s\tum\n0.8\t2\t5\n", "V_in [m/s],e [%],D [um],d50\n2,80,5,7\n",
        "V [m/s],e,Vr [m/s],d_p [um]\n2,0.8,1.7,5\n",
        "speed before (cm/s);speed after (cm/s);d (um)\n200;160;5\n",
        "Velocity before impact [m/s],V_after [m/s],D [um]\n2,1.6,5\n",
        "speed_in [mm/s],velocity_out [m/s],D [um]\n2000,1.6,5\n"}) {
    SCOPED_TRACE(text);
    auto request = place.request(text, ImportFormat::csv);
    request.into = place.folder() / std::to_string(number++);
    const Dataset made = recoil::import_points(request).dataset;
    ASSERT_EQ(made.points.size(), 1U);
    EXPECT_NEAR(made.points[0].incident_velocity, 2.0, 1e-12);
    EXPECT_NEAR(made.points[0].restitution, 0.8, 1e-12);
    EXPECT_NEAR(made.points[0].diameter, 5e-6, 1e-15);
  }
  // A letter without a unit may be anything, as may two columns of one name.
  for (const char* text : {"V,e\n2,0.8\n", "V [m/s],Vi [m/s],e\n2,3,0.8\n"}) {
    EXPECT_THAT(complaint(place.request(text, ImportFormat::csv)),
                HasSubstr("--map incident_velocity=COLUMN:UNIT"));
  }
  // What --map takes is no other quantity.
  auto mapped = place.request("V [m/s],e\n2,1.6\n", ImportFormat::csv);
  mapped.map = {"rebound_velocity=e:m/s"};
  EXPECT_NEAR(recoil::import_points(mapped).dataset.points[0].restitution, 0.8, 1e-12);
  // The header and --map contradict each other.
  auto other = place.request("V (cm/s),e\n2,0.8\n", ImportFormat::csv);
  other.map = {"incident_velocity=\"V (cm/s)\":m/s"};
  other.into = place.folder() / "other";
  EXPECT_THAT(complaint(other), AllOf(HasSubstr("input.csv:1:1:"), HasSubstr("'m/s'")));
}

TEST(Table, RadiansOfTheMapAndAnglesThatCannotBeUsed) {
  const Place place;
  const auto request_of = [&](const std::string& text, const std::string& map) {
    auto request = place.request(text, ImportFormat::csv);
    request.map = {"incident_velocity=V:m/s,restitution=e" + map};
    return request;
  };
  EXPECT_THAT(complaint(request_of("V,e,angle\n2,0.5,60\n", "")),
              AllOf(HasSubstr("input.csv:1:5: the unit of 'angle' is not stated"),
                    HasSubstr("--map 'incidence_angle=\"angle\":UNIT'"), HasSubstr("header")));
  EXPECT_THAT(complaint(request_of("V,e,angle\n2,0.5,95\n", ",incidence_angle=angle:deg")),
              AllOf(HasSubstr("input.csv:2:1: incidence_angle = 95 deg"), HasSubstr("below 90")));
  EXPECT_THAT(complaint(request_of("V,e,et\n2,0.5,0.8\n", ",tangential_restitution=et")),
              AllOf(HasSubstr("input.csv:2:7: a tangential restitution without an incidence angle"),
                    HasSubstr("--map incidence_angle=COLUMN:deg")));
  const auto made =
      recoil::import_points(request_of("V,e,a\n2,0.5,1.2\n3,0.6,\n", ",incidence_angle=a:rad"));
  ASSERT_EQ(made.dataset.points.size(), 1U);  // the row without an angle is left out
  EXPECT_NEAR(made.dataset.points[0].incident_velocity, 2.0 * std::cos(1.2), 1e-10);
}

TEST(Table, UnitsInTheHeaderAndCounts) {
  const Place place;
  auto request = place.request(
      "incident_velocity [cm/s],restitution (%),events,captured\n100,50,20,3\n150,,5,5\n",
      ImportFormat::csv);
  request.diameter_error = "1%";
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_DOUBLE_EQ(made.points[0].incident_velocity, 1.0);
  EXPECT_DOUBLE_EQ(made.points[0].restitution, 0.5);
  EXPECT_EQ(made.points[0].captured, 3);
  EXPECT_TRUE(made.points[1].all_captured());
  EXPECT_NEAR(*made.points[0].diameter_sd, 2e-8, 1e-18);
}

TEST(Table, NoAdhesionAndMaterialsOfAnother) {
  const Place place;
  auto request = place.request("incident_velocity,restitution\n1,0.5\n", ImportFormat::csv);
  request.map = {"incident_velocity=incident_velocity:m/s"};
  request.adhesion_energy = 0.0;
  EXPECT_EQ(*recoil::import_points(request).dataset.system.adhesion_energy, 0.0);
  auto like = place.request("incident_velocity,restitution\n1,0.5\n", ImportFormat::csv);
  like.map = request.map;
  like.particle.clear();
  like.surface.clear();
  like.like = place.folder() / "made";
  like.into = place.folder() / "other";
  const Dataset other = recoil::import_points(like).dataset;
  EXPECT_EQ(other.system.surface.name, "silicon");
  EXPECT_EQ(*other.system.adhesion_energy, 0.0);
  EXPECT_EQ(other.id, "other");
}

TEST(Table, MaterialsFromAFile) {
  const Place place;
  place.write("glass.json",
              R"({"material": "glass", "youngs_modulus": 70e9, "poisson_ratio": 0.2})");
  auto request = place.request(kTable, ImportFormat::csv);
  request.map = {kMap};
  request.surface = (place.folder() / "glass.json").string();
  EXPECT_EQ(recoil::import_points(request).dataset.system.surface.name, "glass");
}

TEST(Table, WhatNobodySaidIsAskedFor) {
  const Place place;
  const auto without = [&](auto change) {
    auto request = place.request(kTable, ImportFormat::csv);
    request.map = {kMap};
    change(request);
    return complaint(request);
  };
  using Request = recoil::ImportRequest;
  EXPECT_THAT(without([](Request& r) { r.particle.clear(); }),
              HasSubstr("the sphere's material is not known"));
  EXPECT_THAT(without([](Request& r) {
                r.particle = "material=x,density=2,youngs_modulus=1e9,poisson_ratio=0";
              }),
              testing::StartsWith("recoil.particle.density = 2 kg/m3"));
  EXPECT_THAT(without([](Request& r) { r.surface.clear(); }), HasSubstr("give --surface FILE"));
  EXPECT_THAT(without([](Request& r) { r.provenance.reset(); }),
              HasSubstr("give --provenance measured"));
  EXPECT_THAT(
      without([](Request& r) { r.particle = "material=x,youngs_modulus=1e9,poisson_ratio=0"; }),
      HasSubstr("density"));
  EXPECT_THAT(without([](Request& r) {
                r.map = {"incident_velocity=Vi:cm/s,rebound_velocity=Vr:cm/s"};
                r.diameters.clear();
              }),
              HasSubstr("give --diameter 4.9um"));
  EXPECT_THAT(without([](Request& r) { r.map = {"incident_velocity=Vi:cm/s"}; }),
              HasSubstr("which column is the rebound?"));
  EXPECT_THAT(without([](Request& r) { r.map = {"incident_velocity=Vx:cm/s"}; }),
              HasSubstr("input.csv:1:1: no column is called 'Vx'"));
  EXPECT_THAT(without([](Request& r) { r.map = {"velocity=Vi:cm/s"}; }),
              AllOf(HasSubstr("unknown quantity 'velocity'"),
                    HasSubstr("did you mean 'incident_velocity'?")));
  EXPECT_THAT(without([](Request& r) { r.map = {"velocity_se=Vi:cm/s"}; }),
              HasSubstr("did you mean 'velocity_sd'?"));
  EXPECT_THAT(without([](Request& r) {
                r.particle.clear();
                r.file = r.file.parent_path() / "nowhere.csv";
              }),
              HasSubstr("nowhere.csv"))
      << "the file is missed before the materials";
  EXPECT_THAT(without([](Request& r) { r.map = {"incident_velocity=Vi:kg"}; }),
              HasSubstr("unknown unit 'kg' of incident_velocity"));
  EXPECT_THAT(without([](Request& r) { r.diameters = {"none=3um"}; }),
              HasSubstr("--diameter 'none=3um': there is no such series"));
  EXPECT_THAT(without([](Request& r) { r.diameters = {"3 miles"}; }),
              HasSubstr("unknown unit 'miles' of --diameter"));
  EXPECT_THAT(without([](Request& r) {
                r.diameters = {"3um", "4um"};
              }),
              HasSubstr("--diameter '4um' is a second diameter of all series"));
}

TEST(Table, NothingIsOverwrittenUnasked) {
  const Place place;
  auto request = place.request(kTable, ImportFormat::csv);
  request.map = {kMap};
  recoil::import_points(request);
  const std::string points = place.read("made/points.csv");
  const std::string package = place.read("made/datapackage.json");
  request = place.request("Vi,Vr\n1,0.5\n", ImportFormat::csv);
  request.map = {"incident_velocity=Vi:m/s,rebound_velocity=Vr:m/s"};
  EXPECT_THAT(complaint(request), HasSubstr("add --replace"));
  EXPECT_EQ(place.read("made/points.csv"), points);
  request.replace = true;
  request.map = {"incident_velocity=Vi:m/s,rebound_velocity=nothing:m/s"};
  EXPECT_THAT(complaint(request), HasSubstr("no column is called 'nothing'"));
  EXPECT_EQ(place.read("made/points.csv"), points);
  EXPECT_EQ(place.read("made/datapackage.json"), package);
}

/// The points of a table of the columns run, D (um), Vi (m/s), e in some form.
Dataset read_form(const Place& place, const std::string& text, const std::string& into,
                  bool decimal_comma = false,
                  const std::string& map =
                      "series=run,diameter=\"D (um)\",incident_velocity=\"Vi "
                      "(m/s)\",restitution=e") {
  auto request = place.request(text, ImportFormat::csv);
  request.map = {map};
  request.decimal_comma = decimal_comma;
  request.into = place.folder() / into;
  return recoil::import_points(request).dataset;
}

TEST(Forms, DelimitersCommentsTitlesAndMarks) {
  // Every form holds the same two points.
  const std::vector<std::pair<std::string, bool>> forms = {
      {"run,D (um),Vi (m/s),e\na,4.9,2.12,0.57\na,4.9,3.1,0.73\n", false},
      {"run;D (um);Vi (m/s);e\na;4,9;2,12;0,57\na;4,9;3,10;0,73\n", true},
      {"run;D (um);Vi (m/s);e\na;4,9;2,12;0,57\na;4,9;3,10;0,73\n", false},
      {"run\tD (um)\tVi (m/s)\te\na\t4.9\t2.12\t0.57\na\t4.9\t3.1\t0.73\n", false},
      {"sep=;\nrun;D (um);Vi (m/s);e\na;4.9;2.12;0.57\na;4.9;3.1;0.73\n", false},
      {"sep=|\r\nrun|D (um)|Vi (m/s)|e\r\na|4.9|2.12|0.57\r\na|4.9|3.1|0.73\r\n", false},
      {"# a \"comment\n# and, with, four, cells\nrun,D (um),Vi (m/s),e\na,4.9,2.12,0.57\n"
       "# the second\na,4.9,3.1,0.73\n",
       false},
      {"\xEF\xBB\xBFrun,D (um),Vi (m/s),e\r\na,4.9,2.12,0.57\r\na,4.9,3.1,0.73\r\n", false},
      {"mass A,,,\nrun,D (um),Vi (m/s),e\na,4.9,2.12,0.57\na,4.9,3.1,0.73\n", false},
      {"mass A\nrun;D (um);Vi (m/s);e\na;4.9;2.12;0.57\na;4.9;3.1;0.73\n", false},
      {"\"run\"  \"D (um)\" \"Vi (m/s)\"\te\n a 4.9 2.12 0.57 \na 4.9  3.1\t0.73\n", false},
  };
  for (std::size_t i = 0; i < forms.size(); ++i) {
    const Place place;
    const Dataset made = read_form(place, forms[i].first, "made", forms[i].second);
    ASSERT_EQ(made.points.size(), 2U) << i;
    EXPECT_EQ(made.series, std::vector<std::string>{"a"}) << i;
    EXPECT_DOUBLE_EQ(made.points[0].diameter, 4.9e-6) << i;
    EXPECT_DOUBLE_EQ(made.points[0].incident_velocity, 2.12) << i;
    EXPECT_DOUBLE_EQ(made.points[1].incident_velocity, 3.1) << i;
    EXPECT_DOUBLE_EQ(made.points[1].restitution, 0.73) << i;
  }
}

TEST(Forms, CommasInsideHeaderCellsOfOtherDelimiters) {
  const Place place;
  const std::string map =
      "series=run,diameter=\"D, mean (um)\",incident_velocity=\"Vi (m/s)\",restitution=e";
  EXPECT_EQ(read_form(place, "run;D, mean (um);Vi (m/s);e\na;4.9;2.12;0.57\n", "a", false, map)
                .points.size(),
            1U);
  EXPECT_EQ(
      read_form(place, "run\tD, mean (um)\tVi (m/s)\te\na\t4.9\t2.12\t0.57\n", "b", false, map)
          .points.size(),
      1U);
}

TEST(Forms, ColumnsWithoutAHeaderAreNumbered) {
  const Place place;
  const Dataset made =
      read_form(place, "1.0 0.56\n0.5 0.28\n", "a", false, "incident_velocity=1:m/s,restitution=2");
  EXPECT_DOUBLE_EQ(made.points[0].incident_velocity, 1.0);
  EXPECT_DOUBLE_EQ(made.points[1].restitution, 0.28);
  // numpy.savetxt writes its header as a comment.
  const Dataset headed = read_form(place, "# Vi e\n1.0 0.56\n0.5 0.28\n", "b", false,
                                   "incident_velocity=Vi:m/s,restitution=e");
  EXPECT_DOUBLE_EQ(headed.points[1].incident_velocity, 0.5);
  const Dataset counted = read_form(place, "#,Vi,e\n1,1.0,0.56\n2,0.5,0.28\n", "c", false,
                                    "incident_velocity=Vi:m/s,restitution=e");
  EXPECT_DOUBLE_EQ(counted.points[1].incident_velocity, 0.5);
}

TEST(Forms, BothLettersMuAndOtherEncodings) {
  const Place place;
  for (const char* const mu : {"\xC2\xB5", "\xCE\xBC", "\xB5"}) {  // the last is Windows-1252
    const std::string name = "D (" + std::string(mu) + "m)";
    const std::string utf8 = std::string(mu).size() == 1 ? "D (\xC2\xB5m)" : name;
    EXPECT_DOUBLE_EQ(read_form(place, "Vi," + name + ",e\n1,4.9,0.5\n", mu, false,
                               "incident_velocity=Vi:m/s,restitution=e,diameter=\"" + utf8 + "\"")
                         .points[0]
                         .diameter,
                     4.9e-6);
  }
  place.write("input.csv", "");
  auto request = place.request("\xFF\xFEV", ImportFormat::csv);
  EXPECT_THAT(complaint(request), HasSubstr("UTF-16"));
}

TEST(Forms, NoBreakSpacesAndTheMinusOfMathematics) {
  const Place place;
  const Dataset made =
      read_form(place, "V\u00A0(m/s),\u202Fe\u00A0\n\u22121.5,\u00A00.8\n\u22122e\u22121,0.7\n",
                "a", false, "incident_velocity=\"V (m/s)\",restitution=e");
  EXPECT_DOUBLE_EQ(made.points[0].incident_velocity, 1.5);  // all come in with a minus
  EXPECT_DOUBLE_EQ(made.points[0].restitution, 0.8);
  EXPECT_DOUBLE_EQ(made.points[1].incident_velocity, 0.2);
}

TEST(Forms, ASuggestedMapIsOneWordOfTheShell) {
  const Place place;
  auto request = place.request("Velocity in m/s,e\n1,0.5\n", ImportFormat::csv);
  request.map = {"incident_velocity=Velocity in m/s,restitution=e"};
  const std::string told = complaint(request);
  const std::string word = "incident_velocity=\"Velocity in m/s\":UNIT";
  EXPECT_THAT(told, HasSubstr("write --map '" + word + "'"));
  request.map = {word.substr(0, word.size() - 4) + "m/s", "restitution=e"};
  EXPECT_DOUBLE_EQ(recoil::import_points(request).dataset.points[0].incident_velocity, 1.0);
}

TEST(Forms, AnEmptyColumnIsNoUnusedOne) {
  const Place place;
  auto request = place.request("V,e,\n1,0.5,\n2,0.6,\n", ImportFormat::csv);
  request.map = {"incident_velocity=V:m/s,restitution=e"};
  const auto unused = [](const recoil::ImportResult& made) {
    std::vector<std::string> names;
    for (const auto& note : made.notes) {
      if (note.remark == recoil::ImportRemark::columns_not_used) names = note.names;
    }
    return names;
  };
  EXPECT_TRUE(unused(recoil::import_points(request)).empty());
  auto filled = place.request("V,e,\n1,0.5,\n2,0.6,wet\n", ImportFormat::csv);
  filled.map = request.map;
  filled.into = place.folder() / "other";
  EXPECT_EQ(unused(recoil::import_points(filled)), std::vector<std::string>{"3 (no header)"});
}

TEST(Forms, WhatIsAmbiguousIsAsked) {
  const auto answer = [](const std::string& text, const std::string& map) {
    const Place place;
    auto request = place.request(text, ImportFormat::csv);
    request.map = {map};
    return complaint(request);
  };
  const std::string map = "incident_velocity=V:m/s,restitution=e";
  EXPECT_THAT(answer("V,V,e\n1,2,0.5\n", map),
              HasSubstr("input.csv:1:3: the column 'V' appears twice"));
  EXPECT_THAT(answer("V,e\n1,0.5\n", "incident_velocity=V:m/s,rebound_velocity=V:m/s"),
              HasSubstr("the column 'V' is taken for both incident_velocity and rebound_velocity"));
  EXPECT_THAT(
      answer("V,e\n\"1,250\",0.5\n", map),
      HasSubstr("write 1250 if the comma groups thousands, 1.250 if it is a decimal comma"));
  EXPECT_THAT(answer("V;e\n1,250;0,500\n", map), HasSubstr("1.250 if it is a decimal comma"));
  EXPECT_THAT(answer("V,e\n1,0.5\n#2,0.5\n", map), HasSubstr("input.csv:3:1: a row that begins"));
  EXPECT_THAT(answer("V,e,s,n\n1,0.5,0.1,4\n", map + ",restitution_sd=s,events=n"),
              HasSubstr("is it that of one impact or of their mean?"));
  EXPECT_THAT(answer("V,R\n-1,0.5\n2,0.5\n", "incident_velocity=V:m/s,rebound_velocity=R:m/s"),
              HasSubstr("the signs of the velocities are mixed"));
  EXPECT_THAT(answer("V,R\n-1,-0.5\n", "incident_velocity=V:m/s,rebound_velocity=R:m/s"),
              HasSubstr("the signs of the velocities are mixed"));
  EXPECT_THAT(answer("V,e\n1,1.71\n", map), HasSubstr("a rebound is not faster than the impact"));
}

TEST(Forms, RowsWithAnEmptyCellAreLeftOutAndNamed) {
  const Place place;
  auto request = place.request("V,e\n1,0.5\n,0.6\n2,\n3,NA\n4,0.7\n", ImportFormat::csv);
  request.map = {"incident_velocity=V:m/s,restitution=e"};
  const auto result = recoil::import_points(request);
  ASSERT_EQ(result.dataset.points.size(), 2U);
  EXPECT_DOUBLE_EQ(result.dataset.points[1].incident_velocity, 4.0);
  EXPECT_EQ(result.notes.front().remark, recoil::ImportRemark::rows_left_out);
  EXPECT_EQ(result.notes.front().names, (std::vector<std::string>{"line 3", "line 4", "line 5"}));
  auto nothing = place.request("V,e\n1,\n", ImportFormat::csv);
  nothing.map = request.map;
  nothing.into = place.folder() / "other";
  EXPECT_THAT(complaint(nothing), HasSubstr("every row has an empty cell"));
}

TEST(Forms, WordsSayWhichSpheresStuck) {
  const Place place;
  auto request =
      place.request("V,R,n,remark\n1,-,20,stuck\n2,,20,Yes\n3,1.5,20,\n4,2.5,20,no\n5,3,20,4\n",
                    ImportFormat::csv);
  request.map = {"incident_velocity=V:m/s,rebound_velocity=R:m/s,events=n,captured=remark"};
  const auto result = recoil::import_points(request);
  ASSERT_EQ(result.dataset.points.size(), 5U);
  const std::vector<int> captured = {20, 20, 0, 0, 4};
  for (std::size_t i = 0; i < captured.size(); ++i) {
    EXPECT_EQ(result.dataset.points[i].captured, captured[i]) << i;
  }
  auto unknown = place.request("V,R,remark\n1,-,perhaps\n3,1.5,\n", ImportFormat::csv);
  unknown.map = {"incident_velocity=V:m/s,rebound_velocity=R:m/s,captured=remark"};
  unknown.into = place.folder() / "other";
  EXPECT_THAT(complaint(unknown), HasSubstr("input.csv:2:5: 'perhaps'"));
  // Without the column, the empty rebound of a row that has the rest is told.
  unknown.map = {"incident_velocity=V:m/s,rebound_velocity=R:m/s"};
  const auto left = recoil::import_points(unknown);
  const auto told = std::ranges::find(left.notes, recoil::ImportRemark::rebounds_empty,
                                      &recoil::ImportNote::remark);
  ASSERT_NE(told, left.notes.end());
  EXPECT_EQ(told->names, std::vector<std::string>{"line 2"});
}

TEST(Forms, UnitsFactorsConstantsAndSigns) {
  const Place place;
  auto request = place.request("v,r,T\n-70,30,20\n-10,5,\n", ImportFormat::csv);
  request.map = {
      "incident_velocity=v:mph,rebound_velocity=r:mph,diameter=2.9in,temperature=T:degC,events=4"};
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_DOUBLE_EQ(made.points[0].incident_velocity, 70.0 * 1609.344 / 3600.0);
  EXPECT_DOUBLE_EQ(made.points[0].restitution, 3.0 / 7.0);
  EXPECT_NEAR(made.points[0].diameter, 2.9 * 0.0254, 1e-12);
  EXPECT_EQ(made.points[1].events, 4);
  EXPECT_NEAR(*made.series_conditions[made.points[0].series].of(recoil::Condition::temperature),
              293.15, 1e-9);
  auto pixels = place.request("v,e\n100,0.5\n", ImportFormat::csv);
  pixels.map = {"incident_velocity=v:0.35mm/s,restitution=e"};
  pixels.into = place.folder() / "pixels";
  EXPECT_DOUBLE_EQ(recoil::import_points(pixels).dataset.points[0].incident_velocity, 0.035);
}

TEST(Forms, ARowOfUnitsBelowTheHeader) {
  const Place place;
  auto request = place.request("V\te\tnote\n(cm/s)\t[%]\t\n100\t50\tx\n", ImportFormat::csv);
  request.map = {"incident_velocity=V,restitution=e"};
  const Dataset made = recoil::import_points(request).dataset;
  ASSERT_EQ(made.points.size(), 1U);
  EXPECT_DOUBLE_EQ(made.points[0].incident_velocity, 1.0);
  EXPECT_DOUBLE_EQ(made.points[0].restitution, 0.5);
}

TEST(Forms, ErrorsBesideTheirValues) {
  const Place place;
  auto request = place.request(
      "V,e\n1.0 +- 0.1,0.85\xC2\xB1"
      "0.02\n2.0,0.83 +/- 0.03\n",
      ImportFormat::csv);
  request.map = {"incident_velocity=V:m/s,restitution=e"};
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_DOUBLE_EQ(*made.points[0].restitution_sd, 0.02);
  EXPECT_DOUBLE_EQ(*made.points[0].velocity_sd, 0.1);
  EXPECT_DOUBLE_EQ(*made.points[1].restitution_sd, 0.03);
  EXPECT_FALSE(made.points[1].velocity_sd.has_value());
}

TEST(Forms, DeviationsOfOneImpactBecomeThoseOfTheMean) {
  for (const auto& [of, sd] : std::vector<std::pair<std::string, double>>{
           {"one", 0.02 / std::sqrt(8.0)}, {"mean", 0.02}}) {
    const Place place;
    auto request = place.request("V,e,sd,N,c\n1.0,0.85,0.02,10,2\n", ImportFormat::csv);
    request.map = {"incident_velocity=V:m/s,restitution=e,restitution_sd=sd,events=N,captured=c"};
    request.sd_of = of;
    // 8 of the 10 rebounded, and e is their mean.
    EXPECT_NEAR(*recoil::import_points(request).dataset.points[0].restitution_sd, sd, 1e-10);
  }
}

TEST(Forms, RepeatsInColumnsAreOnePointEach) {
  const Place place;
  auto request =
      place.request("ball;h1;h2;h3\na;0.81;0.64;\nb;0.49;0.36;0.25\n", ImportFormat::heights);
  request.map = {"series=ball,drop_height=100cm,rebound_height=h1+h2+h3:m"};
  const Dataset made = recoil::import_points(request).dataset;
  std::vector<double> e;
  for (const auto& point : made.points) e.push_back(point.restitution);
  EXPECT_THAT(e, testing::Pointwise(testing::DoubleNear(1e-9), {0.9, 0.8, 0.7, 0.6, 0.5}));
  EXPECT_EQ(made.points[1].setting, "a from 1000 mm");
}

TEST(Forms, MethodAndConditionsOfEveryFormat) {
  const Place place;
  auto request = place.request("1, 0.5\n2, 0.6\n", ImportFormat::webplotdigitizer);
  request.method = "video";
  request.conditions = {"target_thickness=5mm,relative_humidity=40%", "temperature=300"};
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_EQ(made.system.method, recoil::Method::video);
  EXPECT_DOUBLE_EQ(*made.system.conditions.of(recoil::Condition::target_thickness), 0.005);
  EXPECT_DOUBLE_EQ(*made.system.conditions.of(recoil::Condition::relative_humidity), 0.4);
  EXPECT_DOUBLE_EQ(*made.system.conditions.of(recoil::Condition::temperature), 300.0);
  request.conditions = {"relativ_humidity=0.4"};
  request.into = place.folder() / "other";
  EXPECT_THAT(complaint(request), HasSubstr("did you mean 'relative_humidity'?"));
}

TEST(Materials, ByNameWithErrorsAndSources) {
  const Place place;
  auto request = place.request(kTable, ImportFormat::csv);
  request.map = {kMap};
  request.particle = "polystyrene";
  request.surface = "glass,youngs_modulus=72e9";
  const Dataset made = recoil::import_points(request).dataset;
  EXPECT_EQ(made.system.particle.name, "polystyrene");
  EXPECT_DOUBLE_EQ(made.system.particle.density, 1050.0);
  // The range 2.28 to 3.28 GPa as a uniform distribution.
  EXPECT_DOUBLE_EQ(made.system.particle.youngs_modulus, 2.78e9);
  EXPECT_NEAR(made.system.error_of(recoil::Body::particle, recoil::Constant::youngs_modulus),
              1e9 / std::sqrt(12.0), 1.0);
  EXPECT_DOUBLE_EQ(made.system.surface.youngs_modulus, 72e9);
  EXPECT_EQ(made.system.error_of(recoil::Body::surface, recoil::Constant::youngs_modulus), 0.0);
  ASSERT_EQ(made.sources.size(), 3U);
  EXPECT_THAT(made.sources[1], AllOf(HasSubstr("Callister"), HasSubstr("polystyrene")));
  request.particle = "polystyren";
  request.into = place.folder() / "other";
  EXPECT_THAT(complaint(request), HasSubstr("did you mean 'polystyrene'?"));
}

TEST(Materials, AreFoundWhateverIsCalledLikeThemInTheWorkingFolder) {
  const Place place;
  place.write("steel/points.csv", "");
  place.write("Glass", "not JSON");
  place.write("mine", R"({"material": "mine", "youngs_modulus": 60e9, "poisson_ratio": 0.2})");
  auto request = place.request(kTable, ImportFormat::csv);
  request.map = {kMap};
  request.particle = "steel";
  request.surface = "Glass";
  auto own = request;
  own.surface = "mine";
  own.into = place.folder() / "own";
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(place.folder());
  const std::string named = complaint(request);
  const std::string in_file = complaint(own);
  std::filesystem::current_path(before);
  EXPECT_EQ(named, "no error");
  EXPECT_EQ(in_file, "no error");
  const Dataset made = recoil::load_dataset(own.into);
  EXPECT_DOUBLE_EQ(made.system.surface.youngs_modulus, 60e9);
  // The sources are the test's own and that of the table.
  EXPECT_EQ(made.sources.size(), 2U);
}

TEST(Materials, EveryOneOfTheTableIsAccepted) {
  const Place place;
  for (const recoil::TabledMaterial& material : recoil::tabled_materials()) {
    auto request = place.request(kTable, ImportFormat::csv);
    request.map = {kMap};
    request.particle = request.surface = std::string(material.name);
    request.into = place.folder() / std::string(material.name);
    EXPECT_EQ(complaint(request), "no error") << material.name;
  }
}

TEST(Materials, NamesThatMeanTheSame) {
  for (const auto& [said, name] : {std::pair("silica", "fused-silica"),
                                   {"Fused Silica", "fused-silica"},
                                   {"fused_quartz", "fused-silica"},
                                   {"Aluminum", "aluminium"},
                                   {"stainless steel", "stainless"},
                                   {"Polystyrene latex", "polystyrene"},
                                   {"Silicon Carbide", "silicon-carbide"},
                                   {"stone", "granite"}}) {
    EXPECT_EQ(recoil::tabled_material(said, "--particle")["material"], name);
    EXPECT_EQ(recoil::source_of_tabled(said), recoil::source_of_tabled(name));
  }
  // Quartz is a crystal.
  EXPECT_THROW(recoil::tabled_material("quartz", "--particle"), recoil::InputError);
}

TEST(Materials, TungstenCarbideHasTheSpeedsOfSoundOfItsSource) {
  const auto found =
      std::ranges::find(recoil::tabled_materials(), std::string_view("tungsten-carbide"),
                        &recoil::TabledMaterial::name);
  ASSERT_TRUE(found != recoil::tabled_materials().end());
  const double nu = found->poisson_ratio;
  const double shear = found->youngs_modulus() / (2.0 * (1.0 + nu));
  const double transverse = std::sqrt(shear / found->density);
  EXPECT_NEAR(transverse, 4161.2, 5.0);
  EXPECT_NEAR(transverse * std::sqrt((2.0 - 2.0 * nu) / (1.0 - 2.0 * nu)), 6864.0, 10.0);
}

TEST(Materials, WoodAcrossTheGrainHasTheModuliOfItsSource) {
  const auto wood = std::ranges::find(recoil::tabled_materials(), std::string_view("wood"),
                                      &recoil::TabledMaterial::name);
  ASSERT_TRUE(wood != recoil::tabled_materials().end());
  // Bending 12.6 GPa of sugar maple, 12.3 GPa of white oak; ratios E_T / E_L and E_R / E_L.
  EXPECT_NEAR(wood->lowest_modulus / (1.1 * 12.6e9 * 0.065), 1.0, 0.02);
  EXPECT_NEAR(wood->highest_modulus / (1.1 * 12.3e9 * 0.163), 1.0, 0.02);
}

TEST(Table, TheCommandMakesAFitFileAndSaysWhatIsNext) {
  const support::Workplace place;
  place.write("table.csv", "V,e\n1,0.8\n2,0.78\n3,0.77\n4,0.75\n");
  std::vector<std::string> words = {"import",
                                    "table.csv",
                                    "--format",
                                    "csv",
                                    "--into",
                                    "mine",
                                    "--map",
                                    "incident_velocity=V:m/s,restitution=e",
                                    "--particle",
                                    "steel",
                                    "--surface",
                                    "glass",
                                    "--diameter",
                                    "5mm",
                                    "--provenance",
                                    "measured",
                                    "--adhesion-energy",
                                    "0"};
  const auto made = place.run(words);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("next:\n  recoil fit mine/fit.toml"));
  EXPECT_LE(std::ranges::count(made.out, '\n'), 25);
  EXPECT_EQ(place.run({"fit", "mine/fit.toml", "--replicates", "0"}).status, 0);
  // A fit file that is there stays.
  place.write("mine/fit.toml", "dataset = \".\"\n# mine\n");
  words.emplace_back("--replace");
  EXPECT_EQ(place.run(words).status, 0);
  EXPECT_THAT(place.read("mine/fit.toml"), HasSubstr("# mine"));
  EXPECT_THAT(place.run({"materials"}).out, AllOf(HasSubstr("stainless"), HasSubstr("Callister")));
}

TEST(Table, ABallWithoutAdhesionIsReportedAsItIsWritten) {
  const Place place;
  auto request = place.request("V,e\n1,0.8\n2,0.78\n3,0.77\n", ImportFormat::csv);
  request.map = {"incident_velocity=V:m/s", "restitution=e"};
  request.diameters = {"20mm"};
  request.particle = request.surface = "steel";
  request.into = place.folder() / "ball";
  const recoil::Dataset made = recoil::import_points(request).dataset;
  const recoil::Dataset written = recoil::load_dataset(request.into);
  EXPECT_EQ(written.system.adhesion_energy, 0.0);  // adhesion is negligible above a millimetre
  EXPECT_EQ(made.system.adhesion_energy, 0.0);
  EXPECT_EQ(made.sha256, written.sha256);
}

TEST(Table, BounceDrawsItsReadings) {
  const support::Workplace place;
  place.write("drops.csv", "ball,h\nold,64\nold,66\nold,65\nnew,72\nnew,71\nnew,73\n");
  std::vector<std::string> words = {
      "bounce", "drops.csv", "--format", "heights",
      "--ball", "tennis",    "--map",    "series=ball,drop_height=100cm,rebound_height=h:cm",
      "--out",  "e.svg"};
  const auto made = place.run(words);
  ASSERT_EQ(made.status, 0) << made.err;
  const std::string drawn = place.read("e.svg");
  EXPECT_THAT(drawn, AllOf(HasSubstr("<svg"), HasSubstr("old"), HasSubstr("new")));
  EXPECT_EQ(drawn.find("nan"), std::string::npos);
  words.back() = "e.txt";  // states no format
  EXPECT_EQ(place.run(words).status, 2);
}

}  // namespace
