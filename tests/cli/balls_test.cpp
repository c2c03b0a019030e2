// Balls of centimetres that are dropped by hand: no adhesion, one size, several drops from a
// height.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/workplace.hpp"

namespace {

using support::Outcome;
using support::Workplace;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Heights in mm of balls with e = 0.9 that lose a little more when they are faster, read to 1 mm.
std::string heights() {
  std::string text = "h1,h2\n";
  for (const double drop : {100.0, 200.0, 400.0, 800.0}) {
    for (int again = 0; again < 5; ++again) {
      const double e = 0.9 - 0.02 * std::log2(drop / 100.0);
      text += fmt::format("{},{:.0f}\n", drop, drop * e * e + again - 2.0);
    }
  }
  return text;
}

class Balls : public Workplace {
 public:
  Balls() {
    write("heights.csv", heights());
    write("ball.toml",
          "dataset = \"ball\"\n[parameters]\nC_H = { initial = 3e-2, bounds = [0, 1] }\n"
          "[uncertainty]\nreplicates = 19\nseed = 1\n");
    imported = run({"import",
                    "heights.csv",
                    "--format",
                    "heights",
                    "--into",
                    "ball",
                    "--map",
                    "drop_height=h1:mm,rebound_height=h2:mm",
                    "--diameter",
                    "42mm",
                    "--adhesion-energy",
                    "0",
                    "--rebound-error",
                    "2mm",
                    "--provenance",
                    "measured",
                    "--source",
                    "A test",
                    "--ambient-pressure",
                    "0",
                    "--particle",
                    "material=rubber,density=1100,youngs_modulus=5e6,poisson_ratio=0.48",
                    "--surface",
                    "material=steel,youngs_modulus=2e11,poisson_ratio=0.3"});
  }
  Outcome imported;
};

TEST(BallsByHand, AreImportedWithTheirHeightsAndWithoutWarnings) {
  const Balls balls;
  ASSERT_EQ(balls.imported.status, 0) << balls.imported.err;
  EXPECT_THAT(balls.imported.out + balls.imported.err,
              AllOf(Not(HasSubstr("above 1 mm")), Not(HasSubstr("copied by accident"))));
  EXPECT_THAT(balls.read("ball/points.csv"), HasSubstr("heights from 800 mm"));
}

TEST(BallsByHand, AreNotToldOfAdhesionThatIsNotThere) {
  const Balls balls;
  const Outcome fitted = balls.run({"fit", "ball.toml", "--verbose"});
  ASSERT_EQ(fitted.status, 0) << fitted.err;
  EXPECT_THAT(fitted.out,
              AllOf(HasSubstr("none (no adhesion)"), HasSubstr("4 settings, 20 points"),
                    Not(HasSubstr("Two Points")), Not(HasSubstr("wo-point iteration")),
                    Not(HasSubstr("Tabor")), Not(HasSubstr("times the fitted capture velocity")),
                    Not(HasSubstr("e+04 um"))));
}

}  // namespace
