#include "validation/studies/paper_statements.hpp"

#include <cmath>
#include <vector>

namespace recoil::paper {
namespace {

Statement number(std::string_view part, std::string_view id, std::string_view label, double printed,
                 std::string_view unit, double tolerance) {
  return {part, id, label, Kind::number, "", printed, unit, tolerance, false};
}

Statement claim(std::string_view part, std::string_view id, std::string_view label,
                std::string_view words) {
  return {part, id, label, Kind::claim, words, 0.0, "", 0.0, false};
}

Statement obstacle(std::string_view part, std::string_view label, std::string_view words) {
  return {part, "", label, Kind::obstacle, words, 0.0, "", 0.0, false};
}

Statement built_in(Statement statement) {
  statement.is_built_in = true;
  return statement;
}

constexpr std::string_view only_drawn = "They are drawn and were never published as numbers.";

}  // namespace

std::span<const Part> parts() {
  static constexpr Part all[] = {
      {"table-1", "Table 1", "constants of the five contacts"},
      {"fig-3", "Fig. 3", "sizes of the steel spheres"},
      {"fig-4", "Fig. 4", "velocities before and after pairing"},
      {"fig-5", "Fig. 5", "restitution of both steels"},
      {"fig-6", "Fig. 6", "contact force against time"},
      {"fig-7", "Fig. 7", "ammonium fluorescein, four sizes"},
      {"fig-8", "Fig. 8", "adhesion force against radius"},
      {"fig-9", "Fig. 9", "polystyrene on quartz"},
      {"fig-10", "Fig. 10", "smallest, mean and largest steel sphere"},
      {"fig-11", "Fig. 11", "mixture against one size, SST65"},
      {"fig-12", "Fig. 12", "mixture against one size, SST125"},
  };
  return all;
}

std::span<const Statement> statements() {
  // Tolerances: half a unit of the last printed digit, or more where the paper says "about".
  static const std::vector<Statement> all = {
      number("table-1", "molybdenum-K", "K, fluorescein on molybdenum", 1.789, "GPa", 0.005),
      number("table-1", "molybdenum-W", "W, fluorescein on molybdenum", 0.336, "J/m2", 0.01),
      number("table-1", "molybdenum-r", "r, fluorescein on molybdenum", 2.45, "um", 0.01),
      number("table-1", "molybdenum-f0", "{f0}, fluorescein on molybdenum", 8.90, "N/m", 0.01),
      number("table-1", "silicon-K", "K, fluorescein on silicon", 1.776, "GPa", 0.005),
      number("table-1", "silicon-W", "W, fluorescein on silicon", 0.216, "J/m2", 0.01),
      number("table-1", "silicon-r", "r, fluorescein on silicon", 2.45, "um", 0.01),
      number("table-1", "silicon-f0", "{f0}, fluorescein on silicon", 6.60, "N/m", 0.01),
      number("table-1", "mica-K", "K, fluorescein on mica", 1.771, "GPa", 0.005),
      number("table-1", "mica-W", "W, fluorescein on mica", 0.178, "J/m2", 0.01),
      number("table-1", "mica-r", "r, fluorescein on mica", 2.45, "um", 0.01),
      number("table-1", "mica-f0", "{f0}, fluorescein on mica", 5.81, "N/m", 0.01),
      number("table-1", "quartz-K", "K, polystyrene on quartz", 3.745, "GPa", 0.005),
      number("table-1", "quartz-W", "W, polystyrene on quartz", 0.235, "J/m2", 0.01),
      number("table-1", "quartz-r", "r, polystyrene on quartz", 0.64, "um", 0.01),
      number("table-1", "quartz-f0", "{f0}, polystyrene on quartz", 5.74, "N/m", 0.01),
      number("table-1", "steel-K", "K, steel on silicon", 11.4, "GPa", 0.005),
      number("table-1", "steel-W", "W, steel on silicon", 2.72, "J/m2", 0.01),
      number("table-1", "steel-r", "r, steel on silicon", 24.5, "um", 0.01),
      number("table-1", "steel-f0", "{f0}, steel on silicon", 288.0, "N/m", 0.01),
      obstacle("table-1", "E and nu",
               "The paper prints K and W and not the E and nu behind them. Those used here are "
               "handbook values, and those of fluorescein, polystyrene and silicon were chosen "
               "so that they give the printed K."),
      obstacle("table-1", "{C_H} and {C_A}",
               "The paper prints neither for any contact, so no fit can be checked against them."),

      built_in(number("fig-3", "sst65-smallest", "smallest SST65", 20.0, "um", 0.025)),
      built_in(number("fig-3", "sst65-largest", "largest SST65", 110.0, "um", 0.025)),
      built_in(number("fig-3", "sst65-mean", "mean diameter of SST65", 49.0, "um", 0.02)),
      built_in(number("fig-3", "sst125-smallest", "smallest SST125", 60.0, "um", 0.025)),
      built_in(number("fig-3", "sst125-largest", "largest SST125", 125.0, "um", 0.025)),
      built_in(number("fig-3", "sst125-mean", "mean diameter of SST125", 75.0, "um", 0.02)),
      obstacle("fig-3", "heights of the bars",
               "They are drawn and were never published as numbers. The shape here is log-normal "
               "by assumption."),

      number("fig-4", "free-fall", "incoming velocity from 22 cm", 2.08, "m/s", 0.02),
      claim("fig-4", "majority", "rebounds from 22 cm", "Most of the incoming spheres rebound."),
      claim("fig-4", "broadened", "incoming velocities from 4 cm",
            "Second impacts come in more slowly and broaden the distribution."),
      claim("fig-4", "sorted", "after pairing, from 4 cm",
            "The slow second impacts are gone. The paper removes them by a threshold of velocity."),
      obstacle("fig-4", "counts in the bins",
               "They are drawn and were never published as numbers. The events here are made."),

      built_in(number("fig-5", "slowest", "lowest velocity", 0.4, "m/s", 0.125)),
      built_in(number("fig-5", "fastest", "highest velocity", 4.6, "m/s", 0.05)),
      built_in(number("fig-5", "events", "impacts averaged in one point", 40.0, "1", 0.1)),
      built_in(claim("fig-5", "flat", "above 0.5 m/s", "The restitution changes little.")),
      built_in(
          claim("fig-5", "falls", "below 0.5 m/s", "The restitution falls with falling velocity.")),
      built_in(claim("fig-5", "by-size", "SST65 against SST125",
                     "Adhesion shows more in the smaller spheres.")),
      obstacle("fig-5", "single points and their bars", only_drawn),

      built_in(claim("fig-6", "hertz-small", "Hertz dissipation",
                     "It is small: the contact is nearly elastic.")),
      built_in(claim("fig-6", "mainly-adhesion", "loss of energy",
                     "It comes mainly from the adhesion dissipation.")),
      claim("fig-6", "rebound-only", "adhesion dissipation",
            "It is assumed to act during the rebound only."),
      obstacle("fig-6", "forces and times",
               "The curves are drawn and were never published as numbers, nor were {C_H} and {C_A} "
               "behind them."),

      built_in(number("fig-7", "wall-fastest", "highest velocity", 100.0, "m/s", 0.05)),
      built_in(claim("fig-7", "slightly-low", "2.58 {um} on molybdenum",
                     "The curve calibrated at 4.9 {um} is slightly lower than the points.")),
      built_in(claim("fig-7", "same-trend", "trend at 2.58 {um}",
                     "The curve has the trend of the points.")),
      built_in(claim("fig-7", "similar", "silicon and mica",
                     "The other sizes agree there as well as on molybdenum.")),
      obstacle("fig-7", "single points", only_drawn),

      number("fig-8", "slope-molybdenum", "exponent of r, molybdenum", 1.0 / 3.0, "1", 0.001),
      number("fig-8", "slope-silicon", "exponent of r, silicon", 1.0 / 3.0, "1", 0.001),
      number("fig-8", "slope-mica", "exponent of r, mica", 1.0 / 3.0, "1", 0.001),
      obstacle("fig-8", "{f0} of the other sizes",
               "Only {f0} at 4.9 {um} is printed, in Table 1. The others are drawn."),

      built_in(number("fig-9", "quartz-slowest", "lowest velocity", 2.5, "m/s", 0.05)),
      built_in(number("fig-9", "quartz-fastest", "highest velocity", 35.0, "m/s", 0.05)),
      built_in(claim("fig-9", "quartz-falls", "below 15 m/s",
                     "The restitution falls with falling velocity.")),
      built_in(claim("fig-9", "agrees-well", "two points against all points",
                     "The simulation agrees very well with the experiment.")),
      obstacle("fig-9", "single points", only_drawn),

      built_in(
          number("fig-10", "capture-smallest", "capture velocity at 20 {um}", 0.9, "m/s", 0.15)),
      built_in(
          number("fig-10", "capture-largest", "capture velocity at 110 {um}", 0.1, "m/s", 0.15)),
      claim("fig-10", "capture-by-size", "capture against size",
            "The larger the sphere, the smaller its capture velocity."),
      obstacle("fig-10", "stiffness behind the curves",
               "The printed K of steel is a tenth of that of its E and nu. The paper does not say "
               "which one it simulated with."),

      number("fig-11", "bins", "bins of 10 {um}", 9.0, "1", 0.001),
      claim("fig-11", "mixture-65", "SST65 at the lowest velocity",
            "The weighted average predicts slightly better than the mean size, because it "
            "considers captures."),
      obstacle("fig-11", "captured spheres in the average",
               "The paper does not say whether they count as {e} = 0 or are left out."),

      claim("fig-12", "mixture-125", "SST125 at the lowest velocity",
            "The weighted average agrees better than the mean size, most of all at low "
            "velocities."),
      obstacle("fig-12", "captured spheres in the average",
               "The paper does not say whether they count as {e} = 0 or are left out."),
  };
  return all;
}

bool agrees(const Statement& statement, double found) {
  return std::abs(found / statement.printed - 1.0) <= statement.tolerance;
}

}  // namespace recoil::paper
