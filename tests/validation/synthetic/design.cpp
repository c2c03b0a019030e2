#include "validation/synthetic/design.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/random.hpp"

namespace recoil::hidden {
namespace {

struct Body {
  const char* name;
  double density, modulus, ratio;
};
constexpr Body silicon{"silicon [100]", 2330.0, 131e9, 0.28};

/// A target of ammonium fluorescein.
struct Target {
  Body body;
  double adhesion_force;     ///< f0 at 4.9 um [N/m]
  double adhesion_velocity;  ///< V_a there [m/s]
};
// Li, Dunn & Brach (1999), Table 1; handbook densities.
constexpr Target targets[] = {{{"molybdenum", 10280.0, 320e9, 0.31}, 8.90, 2.41},
                              {silicon, 6.60, 1.67},
                              {{"mica", 2800.0, 90e9, 0.30}, 5.81, 1.43}};

void set_bodies(Design& design, const Body& sphere, const Body& surface) {
  design.sphere = sphere.name;
  design.surface = surface.name;
  Base& b = design.base;
  b.density = sphere.density;
  b.youngs_modulus = sphere.modulus;
  b.poisson_ratio = sphere.ratio;
  b.surface_modulus = surface.modulus;
  b.surface_ratio = surface.ratio;
  b.surface_density = surface.density;
}

struct Size {
  const char* name;
  double diameter;  ///< [m]
};

class Draw {
 public:
  Draw(std::uint64_t seed, std::uint64_t index) : stream_(seed, hidden_purpose, index) {}
  /// Even between the ends in the logarithm.
  double log_between(double low, double high) {
    return low * std::pow(high / low, stream_.uniform());
  }
  double between(double low, double high) { return low + (high - low) * stream_.uniform(); }
  std::uint64_t below(std::uint64_t n) { return stream_.below(n); }

 private:
  RandomStream stream_;
};

Row make_row(Draw& draw, std::string name, double diameter, int points, double lowest,
             double highest) {
  Row row{std::move(name), diameter, points, draw.between(1.12, 1.35), lowest, highest, {}};
  for (int i = 0; i < points; ++i) row.jitter.push_back(draw.between(-0.15, 0.15));
  return row;
}

void fluorescein(Draw& draw, Design& design) {
  const Target& target = targets[draw.below(3)];
  const double modulus = 1e7 * std::round(1e-7 * draw.between(1.1e9, 1.3e9));
  set_bodies(design, {"ammonium fluorescein", 1350.0, modulus, 0.33}, target.body);
  Base& b = design.base;
  b.reference_diameter = 4.9e-6;
  b.adhesion_force = 0.01 * std::round(100.0 * target.adhesion_force * draw.log_between(0.9, 1.1));
  b.C_A = draw.between(0.08, 0.16) / target.adhesion_velocity;
  b.C_H = draw.log_between(1.5e-3, 4e-3);
}

void dropped_spheres(Draw& draw, Design& design) {
  const bool large = design.id == "balls";
  const double modulus = 1e7 * std::round(1e-7 * draw.between(2.4e9, 3.2e9));
  set_bodies(design,
             {large ? "polyoxymethylene" : "polyamide 6.6", large ? 1410.0 : 1140.0, modulus, 0.39},
             {"steel", 7850.0, 210e9, 0.29});
  Base& b = design.base;
  design.dropped = true;
  b.reference_diameter = large ? 25e-3 : 6e-3;
  b.C_H = draw.log_between(0.03, 0.08);
  design.scatter = {0.004, 0.001, 0.0};
  design.events = 1;
  design.decimals = 4;
  static constexpr Size small_balls[] = {{"3 mm", 3e-3}, {"6 mm", 6e-3}, {"12 mm", 12e-3}};
  static constexpr Size large_balls[] = {{"12 mm", 12e-3}, {"25 mm", 25e-3}, {"40 mm", 40e-3}};
  for (const Size& size : large ? large_balls : small_balls) {
    design.rows.push_back(make_row(draw, size.name, size.diameter, 5, 0.65, 4.4));
    design.rows.back().repeats = 4;
  }
}

}  // namespace

const std::vector<std::string_view>& design_ids() {
  static const std::vector<std::string_view> ids = {"wall",    "wall-batches", "li",   "wall-one",
                                                    "dahneke", "drops",        "balls"};
  return ids;
}

bool has_several_diameters(std::string_view id) {
  return id == "wall" || id == "wall-batches" || id == "li" || id == "drops" || id == "balls";
}

Design draw_design(std::string_view id, std::uint64_t seed) {
  Draw draw(seed, 0);
  Design design;
  design.id = id;
  Base& b = design.base;
  static constexpr Size wall[] = {
      {"2.58 um", 2.58e-6}, {"3.42 um", 3.42e-6}, {"4.90 um", 4.90e-6}, {"6.89 um", 6.89e-6}};
  if (id == "wall" || id == "wall-batches" || id == "wall-one") {
    fluorescein(draw, design);
    for (const Size& size : wall) {
      if (id == "wall-one" && size.diameter != 4.90e-6) continue;
      if (id == "wall-batches") {
        for (const char* batch : {", first batch", ", second batch"}) {
          design.rows.push_back(
              make_row(draw, std::string(size.name) + batch, size.diameter, 8, 0.5, 100.0));
        }
      } else {
        design.rows.push_back(make_row(draw, size.name, size.diameter, 15, 0.5, 100.0));
      }
    }
  } else if (id == "li") {
    set_bodies(design, {"316 stainless steel", 7900.0, 193e9, 0.30}, silicon);
    b.reference_diameter = 49e-6;
    b.stated_stiffness = 1e7 * std::round(1e-7 * draw.between(10.9e9, 11.9e9));
    b.adhesion_force = std::round(draw.between(270.0, 306.0));
    b.C_A = draw.between(0.015, 0.030);
    b.C_H = draw.log_between(0.008, 0.030);
    static constexpr Size li[] = {
        {"30 um", 30e-6}, {"49 um", 49e-6}, {"75 um", 75e-6}, {"110 um", 110e-6}};
    for (const Size& size : li) {
      design.rows.push_back(make_row(draw, size.name, size.diameter, 15, 0.08, 4.6));
    }
  } else if (id == "dahneke") {
    const double modulus = 1e7 * std::round(1e-7 * draw.between(2.4e9, 2.7e9));
    set_bodies(design, {"polystyrene latex", 1050.0, modulus, 0.35},
               {"fused quartz", 2200.0, 73e9, 0.17});
    b.reference_diameter = 1.27e-6;
    b.adhesion_force = 0.01 * std::round(100.0 * draw.between(5.2, 6.2));
    b.C_A = draw.log_between(2.5e-3, 5e-3);
    b.C_H = draw.log_between(3e-4, 1e-3);
    design.scatter = {0.02, 0.004, 0.01};
    design.events = 100;
    design.decimals = 4;
    design.rows.push_back(make_row(draw, "1.27 um", 1.27e-6, 20, 2.5, 35.0));
  } else if (id == "drops" || id == "balls") {
    dropped_spheres(draw, design);
  } else {
    throw std::invalid_argument("no design '" + std::string(id) + "'");
  }
  return design;
}

double step_of(Readout readout) {
  switch (readout) {
    case Readout::exact:
      return 0.0;
    case Readout::millimetre:
      return 1e-3;
    case Readout::five_millimetres:
      return 5e-3;
    case Readout::millisecond:
      return 1e-3;
    case Readout::frame:
      return 1.0 / 240.0;
  }
  return 0.0;
}

bool reads_times(Readout readout) {
  return readout == Readout::millisecond || readout == Readout::frame;
}

double rounded(Readout readout, double velocity, double restitution) {
  const double step = step_of(readout);
  if (step == 0.0) return restitution;
  const auto on_step = [step](double x) { return step * std::max(std::round(x / step), 1.0); };
  if (reads_times(readout)) {
    const double before = 2.0 * velocity / gravity;
    return on_step(before * restitution) / on_step(before);
  }
  const double drop = velocity * velocity / (2.0 * gravity);
  return std::sqrt(on_step(drop * restitution * restitution) / drop);
}

double rounding_sd(Readout readout, double velocity, double restitution) {
  const double sd = step_of(readout) / std::sqrt(12.0);
  if (reads_times(readout)) {
    const double before = 2.0 * velocity / gravity;
    return std::hypot(sd / before, restitution * sd / before);
  }
  const double drop = velocity * velocity / (2.0 * gravity);
  return sd / (2.0 * drop * restitution);
}

double capture_velocity(const Base& base, const Effects& effects, double diameter, double highest) {
  const auto comes_back = [&](double v) {
    return square_of_restitution(base, effects, v, diameter) > 0.0;
  };
  double high = highest;
  if (!comes_back(high)) return high;
  double low = high;
  do {  // the highest velocity that captures: a window of rebounds may lie above it
    high = low;
    low *= 0.7;
    if (low < 1e-4 * highest) return 0.0;
  } while (comes_back(low));
  for (int i = 0; i < 30; ++i) {
    const double middle = std::sqrt(low * high);
    (comes_back(middle) ? high : low) = middle;
  }
  return high;
}

namespace {

constexpr double by_hand = 0.03;  // range of velocities that were meant to be the same, relative

}  // namespace

std::vector<Point> expected_points(const Design& design, const Effects& effects) {
  std::vector<Point> points;
  for (std::size_t r = 0; r < design.rows.size(); ++r) {
    const Row& row = design.rows[r];
    const double captured = capture_velocity(design.base, effects, row.diameter, row.highest);
    const double from = std::max(row.start * captured, row.lowest);
    if (from > (design.id == "li" ? 0.25 : 0.15) * row.highest) return {};
    const double step = std::log(row.highest / from) / (row.points - 1);
    for (int i = 0; i < row.points; ++i) {
      // The ends stay; between them the spacing is uneven.
      const bool end = i == 0 || i == row.points - 1;
      const double place = i + (end ? 0.0 : row.jitter[static_cast<std::size_t>(i)]);
      const double aimed = from * std::exp(step * place);
      // Heights are set once for all drops; of two jumps none takes the same time.
      const bool alike = !reads_times(design.readout);
      const int kinds = alike ? 1 : row.repeats;
      for (int k = 0; k < kinds; ++k) {
        const double velocity =
            aimed * (1.0 + by_hand * ((k + 0.5) / static_cast<double>(kinds) - 0.5));
        const Expected e =
            expected_point(design.base, effects, design.scatter, velocity, row.diameter, r);
        if (!(e.restitution > 0.05) || !(e.restitution < 1.0)) return {};
        Point point;
        point.row = r;
        point.diameter = row.diameter;
        point.velocity = velocity;
        point.restitution = e.restitution;
        point.sd = e.event_sd / std::sqrt(static_cast<double>(design.events));
        if (design.states_rounding) {
          point.sd = std::hypot(point.sd, rounding_sd(design.readout, velocity, e.restitution));
        }
        point.setting = 1000 * r + static_cast<std::size_t>(i * kinds + k);
        points.insert(points.end(), static_cast<std::size_t>(alike ? row.repeats : 1), point);
      }
    }
  }
  return points;
}

}  // namespace recoil::hidden
