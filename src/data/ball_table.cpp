#include "data/ball_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "data/text.hpp"

namespace recoil {
namespace {

constexpr double gram = 1e-3;  // [kg]

constexpr TabledBall sport_balls[] = {
    {"table-tennis", 40.0 * units::mm, 2.7 * gram,
     "International Table Tennis Federation, The Laws of Table Tennis, 2.3.1 and 2.3.2"},
    // 6.54 to 6.86 cm, 56.0 to 59.4 g
    {"tennis", 67.0 * units::mm, 57.7 * gram,
     "International Tennis Federation, Rules of Tennis, appendix I: the middle of type 2"},
    {"golf", 42.67 * units::mm, 45.93 * gram,
     "United States Golf Association and The R&A, Rules of Golf, appendix III: the smallest "
     "diameter and the largest mass, at which balls are made"},
    // 39.5 to 40.5 mm, 23 to 25 g
    {"squash", 40.0 * units::mm, 24.0 * gram,
     "World Squash Federation, Rules of Squash, specification of the standard ball"},
};

std::string plain_name(std::string name) {
  for (char& c : name) {
    c = c == ' ' || c == '_' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  if (name.ends_with("-ball")) name.resize(name.size() - 5);
  return name;
}

}  // namespace

std::span<const TabledBall> tabled_balls() { return sport_balls; }

const TabledBall& tabled_ball(const std::string& name) {
  const std::string asked = plain_name(name);
  const auto found = std::ranges::find(sport_balls, asked, &TabledBall::name);
  if (found != std::end(sport_balls)) return *found;
  std::vector<std::string> names;
  for (const TabledBall& ball : sport_balls) names.emplace_back(ball.name);
  throw InputError({}, fmt::format("--ball {} is not in the table", quote(name)),
                   did_you_mean(asked, names), "give --diameter and --mass of this ball");
}

}  // namespace recoil
