// What a law of adhesion has to state, and that a further one needs nothing else.
#include "impact/laws.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numeric>
#include <sstream>

#include "impact/impact.hpp"
#include "impact/lanes.hpp"
#include "impact/phase_solver.hpp"
#include "impact/step_solver.hpp"

namespace recoil {
namespace {

/// DMT with half of its pull: the impact of DMT at beta / 2^(2/3).
struct FifthLaw : DmtLaw {
  static constexpr std::string_view equation = "a law of the tests";
  static double strength(const ImpactGroups& g) { return 0.5 * DmtLaw::strength(g); }
  static double strength_slope(const ImpactGroups& g) { return 0.5 * DmtLaw::strength_slope(g); }
  static std::array<double, groups> groups_of(const ImpactGroups& g) {
    return {g.alpha, strength(g), g.gamma};
  }
  static LawPath path_of(const ImpactGroups& g) { return DmtLaw::path_of(as_dmt(g)); }
  static double depth(const ImpactGroups& g) { return DmtLaw::depth(as_dmt(g)); }

  static ImpactGroups as_dmt(ImpactGroups g) {
    g.beta *= std::pow(2.0, -2.0 / 3.0);
    return g;
  }
};

#define FIVE_LAWS(LAW) RECOIL_ADHESION_LAWS(LAW) LAW(fifth, FifthLaw)

TEST(AdhesionLaws, AFurtherLawIsALineInTheList) {
#define TRAITS_OF(name, Law) traits_of<Law>(),
  constexpr std::array five = {FIVE_LAWS(TRAITS_OF)};
#undef TRAITS_OF
  static_assert(five.size() == count_of<AdhesionLaw> + 1);
  EXPECT_EQ(five.back().equation, "a law of the tests");
}

using Pack = Lanes<2>;

TEST(AdhesionLaws, TheSolversRunAnyStructOfALaw) {
  ImpactOptions options;
  options.gradient = true;
  std::vector<ImpactGroups> impacts, same;
  for (const double w : {2.0, 4.0, 10.0, 20.0}) {
    impacts.push_back({0.003 * w, std::pow(w, -0.8), 0.05 * w});
    same.push_back(FifthLaw::as_dmt(impacts.back()));
  }
  std::vector<std::uint32_t> order(impacts.size());
  std::iota(order.begin(), order.end(), 0U);

  std::vector<ImpactResult> by_steps(impacts.size());
  StepSolver<FifthLaw, Pack, true>(impacts, order, options, by_steps).solve();
  std::vector<CoarseImpact> coarse(impacts.size());
  PhaseSolver<FifthLaw, Pack> solver(options);
  std::vector<ImpactResult> by_phases(impacts.size());
  int solved = 0;
  for (const std::uint32_t& i : order) {
    solver.solve_coarsely(impacts, {&i, 1}, coarse);
    if (solver.solve(coarse[i].need, impacts, {&i, 1}, coarse, by_phases)[0]) ++solved;
  }
  EXPECT_EQ(solved, 4);

  options.adhesion = AdhesionLaw::dmt;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const ImpactResult expected = simulate_impact(same[i], options);
    EXPECT_NEAR(by_steps[i].restitution_squared, expected.restitution_squared, 1e-9);
    EXPECT_NEAR(by_steps[i].gradient[1], expected.gradient[1] * std::pow(2.0, -2.0 / 3.0), 1e-7);
    if (!by_phases[i].usable()) continue;
    EXPECT_NEAR(by_phases[i].restitution_squared, expected.restitution_squared, 1e-9);
  }
}

class LawTraits : public testing::TestWithParam<AdhesionLaw> {};
INSTANTIATE_TEST_SUITE_P(Adhesion, LawTraits, testing::ValuesIn(values_of<AdhesionLaw>()),
                         [](const auto& law) { return to_string(law.param); });

TEST_P(LawTraits, JumpsAreALossWithoutDamping) {
  ImpactOptions options;
  options.adhesion = GetParam();
  const double e2 = simulate_impact({0.0, 0.3, 0.0, 0.0, 5.0}, options).restitution_squared;
  EXPECT_EQ(e2 < 1.0 - 1e-4, traits(GetParam()).jumps) << e2;
}

TEST_P(LawTraits, TheRangeMattersWhereTheLawHasOne) {
  ImpactOptions options;
  options.adhesion = GetParam();
  const double near = simulate_impact({0.01, 0.3, 0.1, 0.0, 0.5}, options).restitution_squared;
  const double far = simulate_impact({0.01, 0.3, 0.1, 0.0, 5.0}, options).restitution_squared;
  EXPECT_EQ(near != far, traits(GetParam()).has_range);
}

TEST_P(LawTraits, ADashpotIsRefusedWhereThereIsNone) {
  ImpactOptions options;
  options.adhesion = GetParam();
  options.dashpot = true;
  EXPECT_EQ(simulate_impact_fast({0.01, 0.3, 0.1, 0.05, 5.0}, options).usable(),
            traits(GetParam()).has_dashpot);
}

TEST_P(LawTraits, TheManualSaysTheSame) {
  std::ifstream file(std::string(RECOIL_SOURCE_DIR) + "/docs/adhesion.md");
  std::ostringstream manual;
  manual << file.rdbuf();
  const AdhesionLawTraits& law = traits(GetParam());
  const std::string row =
      "| `" + to_string(GetParam()) + "` | " + std::string(law.elastic_part) + " | " +
      std::string(law.adhesive_part) + " | " + (law.by_force ? "f0 [N/m]" : "W [J/m2]") +
      (law.has_range ? ", z0 [m]" : "") + " | " + std::string(law.undamped_loss) + " |\n";
  EXPECT_NE(manual.str().find(row), std::string::npos) << row;
}

}  // namespace
}  // namespace recoil
