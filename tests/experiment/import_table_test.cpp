// Any table with a column map, what is asked for, and what is written.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "import_folder.hpp"

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
              HasSubstr("--diameter '3 miles' is not a number with a unit"));
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

}  // namespace
