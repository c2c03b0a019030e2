// A diagnosis that takes what it has from an earlier run says what one says that has nothing.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "core/resumable.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/trial.hpp"
#include "json/diagnosis_file.hpp"
#include "report/result_json.hpp"
#include "support/synthetic.hpp"
#include "support/temporary_folder.hpp"

namespace recoil {
namespace {

constexpr std::size_t first_beside_calibration = std::size_t{1} << 32;

/// Points that no single mechanism explains, so that pairs are tried.
Dataset hard_to_explain() {
  synthetic::Design design;
  design.diameters = {2.58e-6, 3.42e-6, 4.9e-6};
  design.velocities = {4.5, 6.5, 9.0, 13.0, 20.0, 30.0, 60.0};
  design.sd = 0.01;
  Dataset data = synthetic::dataset(design);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (ImpactPoint& point : data.points) {
    const double away = std::log(point.incident_velocity / 20.0) / 0.4;
    const double dip = point.series % 2 == 0 ? 0.12 * std::exp(-0.5 * away * away) : 0.0;
    point.restitution = std::max(0.0, point.restitution - dip + 0.01 * normal(random));
  }
  return data;
}

DiagnosisOptions few(std::shared_ptr<KeptRows> kept) {
  DiagnosisOptions options;
  options.simulated = 99;
  options.kept = std::move(kept);
  return options;
}

std::string answer(std::shared_ptr<KeptRows> kept) {
  return diagnosis_json(diagnose(synthetic::spec(), {hard_to_explain()}, few(std::move(kept))));
}

TEST(KeptPieces, AnyPartOfThemGivesTheSameAnswer) {
  const std::string expected = answer(nullptr);
  EXPECT_TRUE(text_of(value_from<DiagnosisFile>(Json::parse(expected)), 2) == expected);
  const support::TemporaryFolder folder;
  {
    const auto kept = std::make_shared<KeptRows>(folder / "all", "k");
    ASSERT_TRUE(answer(kept) == expected);
    kept->keep();
  }
  const auto kept = std::make_shared<KeptRows>(folder / "all", "k");
  const std::size_t all = kept->size();
  std::set<std::size_t> kinds;
  for (const std::size_t piece : kept->pieces()) kinds.insert(piece / first_beside_calibration);
  EXPECT_EQ(kinds, (std::set<std::size_t>{0, 4, 5, 6}))
      << "calibration, singles, screenings, pairs";
  EXPECT_TRUE(answer(kept) == expected);
  EXPECT_EQ(kept->size(), all);

  // Two thirds of them, and a few damaged ones, which are run again.
  std::mt19937 random(1);
  const auto some = std::make_shared<KeptRows>("", "");
  for (const std::size_t piece : kept->pieces()) {
    const Json row = *kept->find(piece);
    const auto drawn = random() % 30;
    if (drawn < 20) some->put(piece, drawn == 0 ? Json::object({{"no", "row"}}) : row);
  }
  EXPECT_TRUE(answer(some) == expected);
  EXPECT_TRUE(some->rows() == kept->rows());

  // And they are what the answer rests on: a mark in every row of one kind changes it.
  for (const std::size_t marked : {0U, 4U, 6U}) {
    const auto changed = std::make_shared<KeptRows>("", "");
    for (const std::size_t piece : kept->pieces()) {
      const Json row = *kept->find(piece);
      Json other = row;
      if (piece / first_beside_calibration == marked && row.size() > 1) {
        if (marked == 0) {
          for (std::size_t k = 1; k < row.size(); ++k) other[k] = 9e9;
        } else {
          other[3][0] = -1e3 - static_cast<double>(piece % 1000);
        }
      }
      changed->put(piece, other);
    }
    EXPECT_FALSE(answer(changed) == expected) << marked;
  }
}

TEST(KeptPieces, HaveNumbersOfTheirOwn) {
  std::set<std::size_t> numbers;
  DiagnosisOptions options;
  for (const std::size_t first : {std::size_t{0}, options.pieces()}) {  // without outlying points
    options.first_piece = first;
    for (const KeptPiece kind : {KeptPiece::single, KeptPiece::screening, KeptPiece::pair}) {
      for (std::size_t k = 0; k < 1000; ++k) numbers.insert(number_of(options, kind, k));
    }
  }
  EXPECT_EQ(numbers.size(), 6000U);
  EXPECT_GT(*numbers.begin(), 2 * options.pieces());
}

TEST(KeptPieces, NumbersComeBackWhateverTheyAre) {
  const std::vector<double> values = {-0.0, 1.0 / 3.0, 5e-324, INFINITY, -INFINITY};
  const std::vector<double> back = row_numbers(Json::parse(row_json(values).dump()));
  EXPECT_EQ(back, values);
  EXPECT_TRUE(std::signbit(back.front()));
  EXPECT_TRUE(std::isnan(row_numbers(Json::parse(row_json({std::nan("")}).dump())).front()));
}

TEST(KeptPieces, AtMostFortyPairsAreFollowedToTheEnd) {
  const Diagnosis found = diagnose(synthetic::spec(), {hard_to_explain()}, few(nullptr));
  const auto followed = std::ranges::count_if(found.pairs, [](const CandidateResult& pair) {
    return pair.set_aside != SetAside::far_behind;
  });
  EXPECT_GT(found.pairs.size(), 100U);
  EXPECT_GT(followed, 0);
  EXPECT_LE(followed, 40);
  EXPECT_NE(found.pairs.front().set_aside, SetAside::far_behind);
}

}  // namespace
}  // namespace recoil
