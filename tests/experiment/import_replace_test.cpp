// A reconstruction whose points are replaced is none any more, and says so everywhere.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>

#include "data/contact.hpp"
#include "import_folder.hpp"
#include "support/workplace.hpp"
#include "validation/recipe/reconstruction.hpp"

namespace {

namespace fs = std::filesystem;
using import_folder::complaint;
using import_folder::Place;
using recoil::ImportFormat;
using recoil::ImportRequest;
using testing::HasSubstr;
using testing::Not;

/// The shipped datasets beside each other, as their recipes want it.
void copy_datasets(const Place& place) {
  fs::copy(fs::path(RECOIL_SOURCE_DIR) / "datasets", place.folder() / "datasets",
           fs::copy_options::recursive);
}

ImportRequest replacement(const Place& place, const std::string& id, const std::string& text) {
  place.write("new.csv", text);
  ImportRequest request;
  request.file = place.folder() / "new.csv";
  request.format = ImportFormat::csv;
  request.into = place.folder() / "datasets" / id;
  request.replace = true;
  return request;
}

const char* const kPoints =
    "series,diameter,incident_velocity,restitution\n"
    "small,2.58,2.5,0.31\nsmall,2.58,20.1,0.77\nlarge,4.9,1.5,0.28\nlarge,4.9,33,0.81\n";

TEST(Replace, EveryShippedReconstructionBecomesDigitisedInOneCommand) {
  const Place place;
  copy_datasets(place);
  int count = 0;
  for (const auto& entry : fs::directory_iterator(place.folder() / "datasets")) {
    const std::string id = entry.path().filename().string();
    const recoil::Dataset before = recoil::load_dataset(entry.path());
    if (before.provenance != recoil::Provenance::reconstruction) continue;
    const auto made = recoil::import_points(replacement(place, id, kPoints));
    const recoil::Dataset after = recoil::load_dataset(entry.path());
    EXPECT_EQ(after.provenance, recoil::Provenance::digitised) << id;
    EXPECT_EQ(after.id, id);
    EXPECT_EQ(after.points.size(), 4U);
    EXPECT_EQ(after.system.particle.name, before.system.particle.name);
    // K and f0 as the paper prints them for steel are not what its elastic constants give.
    EXPECT_EQ(after.system.stiffness_K, std::nullopt) << id;
    EXPECT_EQ(after.system.adhesion_force_f0, std::nullopt) << id;
    EXPECT_EQ(after.system.adhesion_energy, before.system.adhesion_energy) << id;
    EXPECT_FALSE(place.has("datasets/" + id + "/recipe.toml"));
    EXPECT_TRUE(place.has("datasets/" + id + "/recipe-set-aside.toml"));
    // No word of the old claim is left; a size distribution still says that it is one.
    auto package = nlohmann::json::parse(place.read("datasets/" + id + "/datapackage.json"));
    package["resources"].erase(package["resources"].begin() + 1, package["resources"].end());
    for (const char* word : {"reconstruction", "recipe", "not available", "CC0"}) {
      EXPECT_THAT(package.dump(), Not(HasSubstr(word))) << id;
    }
    ++count;
  }
  EXPECT_EQ(count, 6);
}

// The shipped datasets state velocities in m/s and diameters in um.
TEST(Replace, UnitsOfTheDatasetHoldWhereTheFileStatesNone) {
  const std::string points = "\n2.58,250,0.31\n4.9,150,0.28\n4.9,3300,0.81\n";
  const auto import_table = [&](const Place& place, const std::string& header) {
    copy_datasets(place);
    auto request = replacement(place, "wall1990-mica", header + points);
    request.series = "all";
    return request;
  };
  const Place row;
  const auto made =
      recoil::import_points(import_table(row, "diameter,incident_velocity,restitution\num,cm/s,"));
  EXPECT_DOUBLE_EQ(made.dataset.points[0].incident_velocity, 2.5) << "a row of units";
  EXPECT_DOUBLE_EQ(made.dataset.points[0].diameter, 2.58e-6);
  const Place none;
  EXPECT_DOUBLE_EQ(
      recoil::import_points(import_table(none, "diameter,incident_velocity,restitution"))
          .dataset.points[0]
          .incident_velocity,
      250.0);
  const Place other;
  auto renamed = import_table(other, "diameter,V,restitution");
  renamed.map = {"incident_velocity=V"};
  EXPECT_THAT(complaint(renamed), HasSubstr("the unit of 'V' is not stated"));
}

TEST(Replace, TheSizesOfADatasetStay) {
  const Place place;
  copy_datasets(place);
  recoil::import_points(replacement(place, "li1999-sst65-silicon", kPoints));
  const auto package =
      nlohmann::json::parse(place.read("datasets/li1999-sst65-silicon/datapackage.json"));
  ASSERT_EQ(package["resources"].size(), 2U);
  EXPECT_EQ(package["resources"][1]["name"], "sizes");
}

TEST(Replace, ReconstructSaysThatItIsNoneAndSiblingsStillCompare) {
  const Place place;
  copy_datasets(place);
  recoil::import_points(replacement(place, "wall1990-molybdenum", kPoints));
  const auto folder = [&](const char* id) { return (place.folder() / "datasets" / id).string(); };
  // Writing is refused, too: the new points stay.
  for (const bool check : {true, false}) {
    try {
      recoil::reconstruct(folder("wall1990-molybdenum"), check);
      ADD_FAILURE() << "it was taken for a reconstruction";
    } catch (const recoil::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("this is not a reconstruction"));
      EXPECT_THAT(error.what(), HasSubstr("recipe-set-aside.toml"));
    }
  }
  EXPECT_EQ(recoil::load_dataset(folder("wall1990-molybdenum")).points.size(), 4U);
  EXPECT_TRUE(recoil::reconstruct(folder("wall1990-mica"), true).good());
}

TEST(Replace, PointsOfTheRecipeDoNotBecomeDigitised) {
  const Place place;
  copy_datasets(place);
  const std::string own = place.read("datasets/wall1990-mica/points.csv");
  auto request = replacement(place, "wall1990-mica", own);
  EXPECT_THAT(complaint(request), HasSubstr("60 of 60 points are those of the reconstruction"));
  EXPECT_TRUE(place.has("datasets/wall1990-mica/recipe.toml"));
  request.provenance = recoil::Provenance::synthetic;
  EXPECT_EQ(complaint(request), "no error");
}

TEST(Replace, ThePrintedConstantsOfSteelStayWithTheReconstruction) {
  const Place place;
  copy_datasets(place);
  const support::Workplace at;
  const std::string source = (place.folder() / "datasets/li1999-sst65-silicon").string();
  const std::string table = (place.folder() / "new.csv").string();
  place.write("new.csv", kPoints);
  const std::string mine = (place.folder() / "mine").string();
  const std::vector<std::vector<std::string>> ways = {
      {"import", table, "--format", "csv", "--into", mine, "--like", source, "--provenance",
       "measured", "--map",
       "series=series,diameter=diameter:um,incident_velocity=incident_velocity:m/s,"
       "restitution=restitution"},
      {"import", table, "--format", "csv", "--into", source, "--replace"},
  };
  for (const auto& words : ways) {
    const support::Outcome run = at.run(words);
    ASSERT_EQ(run.status, 0) << run.err;
    const std::string said = std::regex_replace(run.out, std::regex("\\s+"), " ");
    EXPECT_THAT(said, HasSubstr("stiffness_K = 11.4 GPa (derived: 113.5 GPa), "
                                "adhesion_force_f0 = 288 N/m (derived: 308.9 N/m)"));
    const recoil::Dataset made = recoil::load_dataset(words[5]);
    const auto package =
        nlohmann::json::parse(support::text_of(fs::path(words[5]) / "datapackage.json"));
    for (const char* key : {"stiffness_K", "adhesion_force_f0", "reference_diameter"}) {
      EXPECT_FALSE(package["recoil"].contains(key)) << words[5] << " " << key;
    }
    EXPECT_EQ(package["recoil"]["adhesion_energy"], 2.72);  // agrees with Gilman's estimates
    // (4/3) / ((1 - 0.3^2) / 193e9 + (1 - 0.28^2) / 131e9), worked out by hand
    EXPECT_NEAR(recoil::derive_contact(made.system, 49e-6).stiffness, 113.473821e9, 1e3);
  }
}

TEST(Replace, MaterialsOfOnesOwnAreWhatOverridesAreHeldAgainst) {
  const Place place;
  copy_datasets(place);
  place.write("new.csv", kPoints);
  ImportRequest request = replacement(place, "li1999-sst65-silicon", kPoints);
  request.surface = "material=rubber,youngs_modulus=5e6,poisson_ratio=0.49";
  auto made = recoil::import_points(request);
  EXPECT_EQ(made.dataset.system.adhesion_energy, std::nullopt);  // 2.72 J/m2 was steel on silicon
  request.adhesion_energy = 0.06;  // stated, not inherited: it is used
  made = recoil::import_points(request);
  EXPECT_EQ(made.dataset.system.adhesion_energy, 0.06);
}

TEST(Replace, TheCommandLine) {
  const Place place;
  copy_datasets(place);
  place.write("fig7.csv", "2.58 um,,4.90 um,\nX,Y,X,Y\n2.1,0.31,1.2,0.35\n5,0.72,4.9,0.81\n");
  const support::Workplace at;
  const std::string into = (place.folder() / "datasets/wall1990-molybdenum").string();
  const support::Outcome run =
      at.run({"import", (place.folder() / "fig7.csv").string(), "--format", "webplotdigitizer",
              "--into", into, "--replace", "--axis", "x=log,1,100", "--axis", "y=linear,0,1",
              "--reading-error", "0.5%", "--source", "Wall et al. (1990), figure 7"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(place.read("datasets/wall1990-molybdenum/datapackage.json"),
              HasSubstr("Wall et al. (1990), figure 7"));
  const support::Outcome check = at.run({"check", into});
  EXPECT_EQ(check.status, 0);
  EXPECT_THAT(check.out, HasSubstr("= digitised"));
  const support::Outcome wrong = at.run({"import", "x.csv", "--format", "pictures", "--into", "d"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("one of webplotdigitizer, heights, intervals, csv"));
  for (const auto& [format, option] :
       std::vector<std::pair<std::string, std::string>>{{"csv", "--drop-error=1mm"},
                                                        {"csv", "--average"},
                                                        {"csv", "--captured-below=0.1"},
                                                        {"csv", "--gravity=1.62"},
                                                        {"heights", "--time-error=1ms"},
                                                        {"heights", "--scatter=10%"},
                                                        {"intervals", "--rebound-error=1mm"},
                                                        {"intervals", "--reading-error=1%"},
                                                        {"webplotdigitizer", "--average"},
                                                        {"heights", "--axis=x=log,1,100"}}) {
    const support::Outcome idle =
        at.run({"import", "x.csv", "--format", format, "--into", "d", option});
    EXPECT_EQ(idle.status, 2);
    const std::string name = option.substr(0, option.find('='));
    EXPECT_THAT(idle.err, HasSubstr(name + " does nothing with --format " + format));
  }
}

}  // namespace
