#include "made_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include "support/temporary_folder.hpp"
#include "validation/truth/impact_truth.hpp"
#include "validation/truth/truth.hpp"

namespace pairs {
namespace {

// Ammonium fluorescein on molybdenum, SI units.
constexpr double density = 1350.0, stiffness = 1.789e9, work = 0.335;
constexpr double C_H = 3e-3, C_A = 0.03;
constexpr double reference_diameter = 4.9e-6, small_diameter = 3.4e-6;
constexpr double second_diameter = 6e-6, second_density = 10220.0;
constexpr double sd = 0.01;                 // of e
constexpr double relative_input_sd = 0.01;  // of V and d
constexpr double differing = 0.05;          // of the capture velocities of single impacts
constexpr int impacts = 400;                // of one point
constexpr int settings = 4;                 // of two points each
constexpr std::size_t bounces = 4;          // of each of two launches

/// One sort of the spheres that a point averages over.
struct Sort {
  double diameter = 0.0, adhesion_factor = 1.0, weight = 1.0;
};

struct Bin {
  double lower, upper, count;  // [um]
};
constexpr std::array<Bin, 3> mixed = {{{4.0, 4.6, 1.0}, {4.6, 5.2, 2.0}, {5.2, 5.8, 1.0}}};

/// A row of the table of points.
struct Point {
  std::string series, setting, launch;
  double diameter = 0.0, velocity = 0.0;
  std::optional<double> restitution;
  int captured = 0;
};

/// The impacts behind a choice of features.
class Experiment {
 public:
  explicit Experiment(const Choice& choice)
      : choice_(choice), random_(stream_of(words_of(choice))) {}

  std::vector<Point> points() {
    if (is("launch", "yes")) {
      for (int launch = 0; launch < 2; ++launch) add_launch(launch);
    } else {
      for (int setting = 0; setting < settings; ++setting) add_setting(setting);
    }
    add_captures();
    for (Point& point : points_) {
      if (point.restitution) point.restitution = std::max(0.0, *point.restitution);
    }
    return points_;
  }

 private:
  static std::mt19937_64 stream_of(const std::string& words) {
    std::seed_seq seed(words.begin(), words.end());
    return std::mt19937_64(seed);
  }
  bool is(const std::string& feature, const std::string& form) const {
    return choice_.at(feature) == form;
  }
  double normal() { return std::normal_distribution<double>()(random_); }

  int series_count() const { return is("scheme", "cluster") ? 4 : 2; }
  double diameter_of(int series) const {
    // Spheres of one nominal diameter are one batch; whole series can be drawn of several.
    const double batch =
        is("scheme", "cluster") && is("diameter_sd", "yes") ? 1.0 + 0.005 * series : 1.0;
    return batch *
           (is("sizes", "several") && series % 2 == 1 ? small_diameter : reference_diameter);
  }

  /// e of one sphere, the part of the mechanism that acts in the contact included.
  double restitution_of(const Sort& sort, double velocity) const {
    recoil::TrueContact contact;
    contact.law = is("law", "ring")  ? recoil::TrueAdhesion::ring
                  : is("law", "dmt") ? recoil::TrueAdhesion::dmt
                                     : recoil::TrueAdhesion::jkr;
    const auto mass_of = [](double of, double size) {
      return of * std::numbers::pi / 6.0 * std::pow(size, 3);
    };
    contact.radius = sort.diameter / 2.0;
    contact.mass = mass_of(density, sort.diameter);
    if (is("sizes", "two spheres")) {
      contact.radius = 0.5 / (1.0 / sort.diameter + 1.0 / second_diameter);
      contact.mass = 1.0 / (1.0 / contact.mass + 1.0 / mass_of(second_density, second_diameter));
    }
    contact.stiffness = stiffness;
    contact.C_H = C_H;
    if (!is("law", "none")) {
      contact.adhesion = contact.law == recoil::TrueAdhesion::ring
                             ? recoil::recipe_adhesion_force(stiffness, work, 2.0 * contact.radius)
                             : work;
      contact.adhesion *= sort.adhesion_factor;
      if (is("mechanism", "size_law")) {
        contact.adhesion *= std::pow(sort.diameter / reference_diameter, 0.3);
      }
      contact.C_A = C_A;
    }
    double square = std::pow(recoil::true_impact(contact, velocity).restitution, 2);
    if (square == 0.0) return 0.0;
    if (is("mechanism", "plastic_yield")) square *= std::min(1.0, std::pow(velocity / 8.0, -0.5));
    if (is("mechanism", "hysteretic_loss")) square *= 0.95;
    if (is("mechanism", "adhesion_hysteresis")) square -= 0.1 * std::pow(velocity, -1.2);
    if (is("mechanism", "gas_film")) square -= 0.1 / velocity;
    return square > 0.0 ? std::sqrt(square) : 0.0;
  }

  std::vector<Sort> sorts_of(double diameter) const {
    std::vector<Sort> sorts;
    const int shares = 3;
    for (const Bin& bin : mixed) {
      for (int k = 0; k < shares; ++k) {
        const double size = bin.lower + (bin.upper - bin.lower) * (k + 0.5) / shares;
        if (is("sizes", "mixed")) sorts.push_back({size * 1e-6, 1.0, bin.count / shares});
      }
    }
    if (sorts.empty()) sorts.push_back({diameter});
    if (!is("mechanism", "survivor_bias")) return sorts;
    std::vector<Sort> spread;  // five-point Gauss-Hermite rule
    for (const auto& [z, weight] : std::array<std::pair<double, double>, 5>{{{-2.857, 0.0113},
                                                                             {-1.356, 0.2221},
                                                                             {0.0, 0.5333},
                                                                             {1.356, 0.2221},
                                                                             {2.857, 0.0113}}}) {
      for (const Sort& sort : sorts) {
        spread.push_back({sort.diameter, std::exp(0.15 * z), weight * sort.weight});
      }
    }
    return spread;
  }

  /// Mean e over the spheres that rebound; nullopt without any.
  std::optional<double> mean_restitution(double diameter, double velocity) const {
    double sum = 0.0;
    double back = 0.0;
    for (const Sort& sort : sorts_of(diameter)) {
      const double e = restitution_of(sort, velocity);
      if (e == 0.0) continue;
      sum += sort.weight * e;
      back += sort.weight;
    }
    return back > 0.0 ? std::optional(sum / back) : std::nullopt;
  }

  /// Where a sphere of this size begins to rebound [m/s]; 1 without adhesion.
  double capture_velocity(double diameter) const {
    if (is("law", "none")) return 1.0;
    double low = 0.05;
    double high = 50.0;
    for (int k = 0; k < 14; ++k) {
      const double middle = std::sqrt(low * high);
      (restitution_of({diameter}, middle) > 0.0 ? high : low) = middle;
    }
    return high;
  }

  /// An error that all impacts with this name share, in standard deviations.
  double shared(const std::string& name) {
    return shared_.try_emplace(name, normal()).first->second;
  }

  /// What is read of a point of which `point` says the conditions, before the error of e itself.
  double read(Point& point) {
    const double offset = is("mechanism", "velocity_offset") ? 0.05 : 0.0;
    double velocity = point.velocity - offset;
    double diameter = point.diameter;
    if (is("velocity_sd", "yes")) velocity *= 1.0 + relative_input_sd * normal();
    if (is("diameter_sd", "yes")) {
      const bool batch = !is("series_diameter_sd", "yes");
      diameter *=
          1.0 + relative_input_sd *
                    (batch ? shared("size " + std::to_string(1e9 * point.diameter)) : normal());
    }
    double ratio = 1.0;
    if (is("setting_velocity_sd", "yes")) {
      ratio += relative_input_sd * shared("velocity of " + point.setting);
      velocity *= ratio;
    }
    if (is("series_diameter_sd", "yes")) {
      diameter *= 1.0 + relative_input_sd * shared("diameter of " + point.series);
    }
    double e = mean_restitution(diameter, velocity).value_or(0.0) * ratio;
    e = (e * velocity + offset) / (velocity + offset);
    if (!is("setting", "no")) e += sd * shared("error of " + point.setting);
    if (is("mechanism", "series_offset") && point.series != "s0") e += 0.02;
    return e;
  }

  Point begun(int series, const std::string& setting, double times_capture) {
    Point point;
    point.series = fmt::format("s{}", series);
    point.setting = setting;
    point.diameter = diameter_of(series);
    point.velocity = times_capture * capture_velocity(point.diameter);
    return point;
  }

  void add_setting(int setting) {
    for (int k = 0; k < 2; ++k) {
      Point point = begun(setting % series_count(), fmt::format("v{}", setting),
                          1.35 * std::pow(20.0, setting / (settings - 1.0)));
      point.restitution = read(point) + sd * normal();
      points_.push_back(point);
    }
  }

  /// Four bounces, whose instants have errors of equal size.
  void add_launch(int launch) {
    const std::array<double, 2> begins = {25.0, 4.0};
    std::array<double, bounces + 2> instants{};
    for (double& instant : instants) instant = normal();
    Point point = begun(launch % series_count(), fmt::format("l{}", launch),
                        begins.at(static_cast<std::size_t>(launch)));
    point.launch = point.setting;
    for (std::size_t k = 0; k < bounces; ++k) {
      const double e = read(point);
      const std::array<double, 3> parts = {1.0, -(1.0 + 1.0 / e), 1.0 / e};
      const double length = std::hypot(parts[0], parts[1], parts[2]);
      double error = 0.0;
      for (std::size_t j = 0; j < 3; ++j) error += parts.at(j) / length * instants.at(k + j);
      point.restitution = e + sd * error;
      points_.push_back(point);
      point.velocity *= *point.restitution;
    }
  }

  /// Rows at which spheres stick.
  void add_captures() {
    const std::string form = choice_.at("captures");
    if (form != "whole" && form != "mixed" && form != "counts") return;
    for (int k = 0; k < 2; ++k) {
      Point point =
          begun(k, fmt::format("c{}", k), form == "whole" ? 0.7 + 0.1 * k : 1.02 + 0.03 * k);
      const std::vector<Sort> sorts = sorts_of(point.diameter);
      std::vector<double> weights;
      for (const Sort& sort : sorts) weights.push_back(sort.weight);
      std::discrete_distribution<std::size_t> sort(weights.begin(), weights.end());
      double sum = 0.0;
      constexpr int simulated = 40;
      int stay = 0;
      for (int i = 0; i < simulated; ++i) {
        const double e =
            restitution_of(sorts[sort(random_)], point.velocity * std::exp(differing * normal()));
        sum += e;
        if (e == 0.0) ++stay;
      }
      if (form == "whole") stay = simulated;
      point.captured = stay * impacts / simulated;
      if (stay < simulated && form == "mixed") {
        point.restitution = sum / (simulated - stay) + sd * normal();
      }
      points_.push_back(point);
    }
  }

  const Choice& choice_;
  std::mt19937_64 random_;
  std::map<std::string, double> shared_;
  std::vector<Point> points_;
};

/// The angle between the path of a point's spheres and the normal, where it is stated [deg].
double degrees_of(const Point& point) { return point.series == "s0" ? 6.0 : 25.0; }

/// A column of points.csv.
struct Column {
  std::string name, unit;
  std::function<std::string(const Point&)> cell;
};

std::vector<Column> columns_of(const Choice& choice) {
  const auto is = [&choice](const std::string& feature, const std::string& form) {
    return choice.at(feature) == form;
  };
  const auto number = [](double value) { return fmt::format("{:.6f}", value); };
  // The velocities of the points are along the normal, those of the table along the path.
  const auto cosine = [=](const Point& p) {
    return is("incidence_angle", "yes") ? std::cos(degrees_of(p) * std::numbers::pi / 180.0) : 1.0;
  };
  std::vector<Column> columns = {
      {"series", "", [](const Point& p) { return p.series; }},
      {"diameter", "um", [=](const Point& p) { return number(p.diameter * 1e6); }},
      {"incident_velocity", "m/s", [=](const Point& p) { return number(p.velocity / cosine(p)); }},
      {"restitution", "1",
       [=](const Point& p) { return p.restitution ? number(*p.restitution) : std::string(); }}};
  const auto add = [&](bool is_there, const std::string& name, const std::string& unit,
                       const std::function<std::string(const Point&)>& cell) {
    if (is_there) columns.push_back({name, unit, cell});
  };
  const auto of_velocity = [=](const Point& p) {
    return number(relative_input_sd * p.velocity / cosine(p));
  };
  const auto of_diameter = [=](const Point& p) {
    return number(relative_input_sd * p.diameter * 1e6);
  };
  add(is("restitution_sd", "yes"), "restitution_sd", "1", [=](const Point&) { return number(sd); });
  add(is("velocity_sd", "yes"), "velocity_sd", "m/s", of_velocity);
  add(is("diameter_sd", "yes"), "diameter_sd", "um", of_diameter);
  add(is("setting_velocity_sd", "yes"), "setting_velocity_sd", "m/s", of_velocity);
  add(is("series_diameter_sd", "yes"), "series_diameter_sd", "um", of_diameter);
  add(is("incidence_angle", "yes"), "incidence_angle", "deg",
      [=](const Point& p) { return number(degrees_of(p)); });
  add(!is("setting", "no"), "setting", "", [](const Point& p) { return p.setting; });
  add(is("launch", "yes"), "launch", "", [](const Point& p) { return p.launch; });
  add(!is("captures", "none") || is("sizes", "mixed"), "events", "1",
      [](const Point&) { return std::to_string(impacts); });
  add(!is("captures", "none"), "captured", "1",
      [](const Point& p) { return std::to_string(p.captured); });
  return columns;
}

std::string package_of(const Choice& choice, const std::vector<Column>& columns) {
  using Json = nlohmann::ordered_json;
  Json fields = Json::array();
  for (const Column& column : columns) {
    const bool counts = column.name == "events" || column.name == "captured";
    Json field = {{"name", column.name},
                  {"type", column.unit.empty() ? "string"
                           : counts            ? "integer"
                                               : "number"}};
    if (!column.unit.empty()) field["unit"] = column.unit;
    fields.push_back(field);
  }
  Json resources =
      Json::array({{{"name", "points"}, {"path", "points.csv"}, {"schema", {{"fields", fields}}}}});
  const bool uncertain = choice.at("materials") != "exact";
  const auto constant = [&](double value, double relative) {
    return uncertain ? Json{{"value", value}, {"relative_sd", relative}} : Json(value);
  };
  Json system = {{"provenance", "synthetic"},
                 {"particle",
                  {{"material", "ammonium fluorescein"},
                   {"density", density},
                   {"youngs_modulus", 1.2e9},
                   {"poisson_ratio", 0.33}}},
                 {"surface",
                  {{"material", "molybdenum"},
                   {"density", second_density},
                   {"youngs_modulus", 320e9},
                   {"poisson_ratio", 0.31}}},
                 {"stiffness_K", constant(stiffness, 0.1)},
                 {"reference_diameter", reference_diameter}};
  system["adhesion_energy"] = choice.at("law") == "none" ? Json(0.0) : constant(work, 0.1);
  if (choice.at("sizes") == "two spheres") system["surface"]["diameter"] = second_diameter;
  if (choice.at("sizes") == "mixed") {
    system["mixed_sizes"] = "sizes.csv";
    Json of_sizes = Json::array();
    for (const char* name : {"lower", "upper", "count"}) {
      of_sizes.push_back({{"name", name}, {"type", "number"}});
    }
    of_sizes[0]["unit"] = of_sizes[1]["unit"] = "um";
    resources.push_back(
        {{"name", "sizes"}, {"path", "sizes.csv"}, {"schema", {{"fields", of_sizes}}}});
  }
  return Json{{"name", "made"}, {"resources", resources}, {"recoil", system}}.dump(2);
}

std::string fit_of(const Choice& choice) {
  const std::string law = choice.at("law");
  std::string fit = "dataset = \"data\"\n[model]\n";
  if (law != "none") fit += fmt::format("adhesion = \"{}\"\n", law);
  if (choice.at("mechanism") != "none") {
    fit += fmt::format("mechanisms = [\"{}\"]\n", choice.at("mechanism"));
  }
  fit += "[noise]\n";
  if (choice.at("residuals") == "student") fit += "residuals = \"student\"\n";
  if (choice.at("setting") == "stated") fit += fmt::format("setting_sd = {}\n", sd);
  fit += fmt::format(
      "[uncertainty]\nreplicates = 19\nlevel = 0.9\nown_design = false\nscheme = \"{}\"\n",
      choice.at("scheme"));
  const std::map<std::string, std::string> materials = {
      {"exact", "false"}, {"propagated", "true"}, {"adjusted", "\"adjust\""}};
  const auto stated = materials.find(choice.at("materials"));
  if (stated != materials.end()) fit += "materials = " + stated->second + "\n";
  return fit;
}

}  // namespace

const std::vector<Feature>& features() {
  static const std::vector<std::string> no_or_yes = {"no", "yes"};
  static const std::vector<Feature> all = {
      {"law", {"ring", "jkr", "none"}},
      {"mechanism",
       {"none", "plastic_yield", "hysteretic_loss", "gas_film", "adhesion_hysteresis",
        "velocity_offset", "survivor_bias", "series_offset", "size_law"}},
      {"sizes", {"one", "several", "mixed", "two spheres"}},
      {"restitution_sd", {"yes", "no"}},
      {"velocity_sd", no_or_yes},
      {"diameter_sd", no_or_yes},
      {"setting_velocity_sd", no_or_yes},
      {"series_diameter_sd", no_or_yes},
      {"setting", {"no", "estimated", "stated"}},
      {"launch", no_or_yes},
      {"incidence_angle", no_or_yes},
      {"materials", {"exact", "propagated", "adjusted", "averaged"}},
      {"residuals", {"normal", "student"}},
      {"scheme", {"parametric", "residual", "wild", "case", "cluster"}},
      {"captures", {"none", "counted", "whole", "mixed", "counts"}}};
  return all;
}

const std::vector<Pair>& refused_pairs() {
  static const std::vector<Pair> refused = [] {
    std::vector<Pair> pairs = {// its dashpot does not vanish where that contact separates
                               // its law holds for a flat
                               pair_of({"sizes", "two spheres"}, {"mechanism", "gas_film"}),
                               // errors that points share are normal
                               pair_of({"residuals", "student"}, {"setting", "stated"}),
                               pair_of({"residuals", "student"}, {"setting_velocity_sd", "yes"}),
                               pair_of({"residuals", "student"}, {"diameter_sd", "yes"}),
                               pair_of({"residuals", "student"}, {"series_diameter_sd", "yes"})};
    // single points cannot be exchanged if they share errors
    for (const char* scheme : {"residual", "wild", "case"}) {
      pairs.push_back(pair_of({"scheme", scheme}, {"setting_velocity_sd", "yes"}));
      pairs.push_back(pair_of({"scheme", scheme}, {"setting", "stated"}));
      pairs.push_back(pair_of({"scheme", scheme}, {"setting", "estimated"}));
      pairs.push_back(pair_of({"scheme", scheme}, {"diameter_sd", "yes"}));
      pairs.push_back(pair_of({"scheme", scheme}, {"series_diameter_sd", "yes"}));
      pairs.push_back(pair_of({"scheme", scheme}, {"launch", "yes"}));
    }
    return pairs;
  }();
  return refused;
}

const std::vector<Pair>& pairs_left_out() {
  static const std::vector<Pair> left_out = [] {
    std::vector<Pair> pairs;
    // without adhesion nothing is captured
    for (const char* form : {"whole", "mixed", "counts"}) {
      pairs.push_back(pair_of({"law", "none"}, {"captures", form}));
    }
    // every point is nine spheres, or nine times nine
    for (const char* mechanism : {"survivor_bias", "adhesion_hysteresis"}) {
      pairs.push_back(pair_of({"mechanism", mechanism}, {"sizes", "mixed"}));
    }
    return pairs;
  }();
  return left_out;
}

Choice plain_choice() {
  Choice plain;
  for (const Feature& feature : features()) plain[feature.name] = feature.forms.front();
  return plain;
}

void write_fit(const Choice& choice, const std::filesystem::path& folder) {
  const std::vector<Column> columns = columns_of(choice);
  std::string table;
  for (const Column& column : columns) table += (table.empty() ? "" : ",") + column.name;
  table += "\n";
  for (const Point& point : Experiment(choice).points()) {
    std::string row;
    for (const Column& column : columns) {
      row += (&column == &columns.front() ? "" : ",") + column.cell(point);
    }
    table += row + "\n";
  }
  support::write_text(folder / "data/points.csv", table);
  support::write_text(folder / "data/datapackage.json", package_of(choice, columns));
  support::write_text(folder / "fit.toml", fit_of(choice));
  if (choice.at("sizes") != "mixed") return;
  std::string sizes = "lower,upper,count\n";
  for (const Bin& bin : mixed) sizes += fmt::format("{},{},{}\n", bin.lower, bin.upper, bin.count);
  support::write_text(folder / "data/sizes.csv", sizes);
}

}  // namespace pairs
