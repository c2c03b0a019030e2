#include "validation/studies/rank_study.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.hpp"
#include "core/resumable.hpp"
#include "estimate/fit.hpp"
#include "uncertainty/posterior.hpp"
#include "validation/studies/study.hpp"
#include "validation/truth/truth.hpp"

namespace recoil {
namespace {

constexpr auto rank_purpose = static_cast<RandomPurpose>(1001);  // no command of recoil draws it

// The prior: flat between these bounds [s/m], density and Young's modulus as their errors state.
constexpr double lower_C_H = 1e-3, upper_C_H = 6e-3;
constexpr double lower_C_A = 0.01, upper_C_A = 0.09;
constexpr double density_sd = 0.05, modulus_sd = 0.10;  // relative
constexpr double event_spread = 0.08;                   // of the velocity, from impact to impact
constexpr int events = 20;
constexpr double diameters[] = {2.58e-6, 4.9e-6};  // [m]

FitSpec spec_of(RankArm arm) {
  FitSpec spec;
  spec.id = "ranks";
  for (const Parameter& parameter : base_parameters()) {
    ParameterSpec& own = spec.parameters.emplace_back(default_of(parameter));
    if (!parameter.is_damping()) continue;
    const bool is_C_H = spec.parameters.size() == 1;
    own.bounds_stated = own.mentioned = true;
    own.lower = is_C_H ? lower_C_H : lower_C_A;
    own.upper = is_C_H ? upper_C_H : upper_C_A;
    own.initial = 0.5 * (own.lower + own.upper);
  }
  spec.uncertainty.materials =
      arm == RankArm::uncertain_constants ? Materials::adjusted : Materials::exact;
  if (arm == RankArm::estimated_noise) spec.noise.variance = VarianceFunction::constant;
  return spec;
}

/// K and f0 from the recipes' own equations.
Truth truth_with(double C_H, double C_A, double density, double modulus) {
  ImpactSystem system = fluorescein_on_molybdenum().system;
  system.particle.density = density;
  system.particle.youngs_modulus = modulus;
  Truth truth = undamped_truth(system.particle, system.surface, *system.reference_diameter);
  truth.C_H = C_H;
  truth.C_A = C_A;
  return truth;
}

/// A point of `events` impacts whose velocities differ; e is read to 0.03 for each.
ImpactPoint counted_point(const Truth& truth, ImpactPoint point, RandomStream& random) {
  constexpr double reading = 0.03;
  const double V = point.incident_velocity;
  double sum = 0.0;
  point.events = events;
  point.counted = true;
  point.captured = 0;
  for (int k = 0; k < events; ++k) {
    const double e =
        true_restitution(truth, point.diameter, V * std::exp(event_spread * random.normal()));
    point.captured += e > 0.0 ? 0 : 1;
    if (e > 0.0) sum += e + reading * random.normal();
  }
  const int rebounds = events - point.captured;
  point.restitution = rebounds > 0 ? std::max(0.0, sum / rebounds) : 0.0;
  const double less = true_restitution(truth, point.diameter, V * (1.0 - event_spread));
  const double more = true_restitution(truth, point.diameter, V * (1.0 + event_spread));
  point.restitution_sd =
      std::hypot(reading, 0.5 * (more - less)) / std::sqrt(std::max(rebounds, 1));
  return point;
}

/// The data of the truth at velocities from 1.6 (with captures: 0.5) times the capture velocity in
/// the middle of the prior. Where some point has rebounds and captures, the spread of the impacts
/// is known; steps of a fifth make such a point wherever in the prior the truth is.
Dataset made_data(RankArm arm, const Truth& truth, RandomStream& random) {
  const bool counts = arm == RankArm::captures;
  const Truth middle =
      truth_with(0.5 * (lower_C_H + upper_C_H), 0.5 * (lower_C_A + upper_C_A), 1350.0, 1.2e9);
  // Log-uniform over a factor of 4: posteriors with the prior 1 / scale are calibrated at any.
  const double sd =
      arm == RankArm::estimated_noise ? 0.005 * std::pow(4.0, random.uniform()) : 0.01;
  Dataset data = fluorescein_on_molybdenum();
  if (arm == RankArm::uncertain_constants) {
    data.system.errors = {{Body::particle, Constant::density, density_sd * 1350.0},
                          {Body::particle, Constant::youngs_modulus, modulus_sd * 1.2e9}};
  }
  for (const double diameter : diameters) {
    const double capture = true_capture_velocity(middle, diameter);
    data.series.push_back(fmt::format("{}", data.series.size()));
    const auto velocities = counts ? std::array{0.5, 0.61, 0.74, 0.9, 1.1, 1.34, 1.63, 4.0, 16.0}
                                   : std::array{1.6, 2.0, 2.7, 3.8, 5.5, 9.0, 16.0, 30.0, 60.0};
    for (const double times : velocities) {
      ImpactPoint point;
      point.series = data.series.size() - 1;
      point.diameter = diameter;
      point.incident_velocity = capture * times;
      if (counts) {
        data.points.push_back(counted_point(truth, point, random));
        continue;
      }
      point.restitution =
          true_restitution(truth, diameter, point.incident_velocity) + sd * random.normal();
      if (arm != RankArm::estimated_noise) point.restitution_sd = sd;
      data.points.push_back(point);
    }
  }
  return data;
}

std::vector<std::string> rank_parameters(RankArm arm) {
  if (arm != RankArm::uncertain_constants) return {"C_H", "C_A"};
  return {"C_H", "C_A", "density", "Young's modulus"};
}

/// The rank of every parameter that moves in data set `index` of an arm, in the order of
/// `rank_parameters`; empty where the posterior did not settle. The parameters are drawn from the
/// prior, the data by the simulator that shares no code with the fitter.
std::vector<double> ranks_of(RankArm arm, std::uint64_t index, std::uint64_t seed, int threads) {
  const std::uint64_t stream = 1000000 * static_cast<std::uint64_t>(arm) + index;
  RandomStream random(seed, rank_purpose, stream);
  std::vector<double> truth = {lower_C_H + (upper_C_H - lower_C_H) * random.uniform(),
                               lower_C_A + (upper_C_A - lower_C_A) * random.uniform()};
  double density = 1350.0, modulus = 1.2e9;
  if (arm == RankArm::uncertain_constants) {
    density *= std::exp(std::sqrt(std::log1p(density_sd * density_sd)) * random.normal());
    modulus *= std::exp(std::sqrt(std::log1p(modulus_sd * modulus_sd)) * random.normal());
    truth.insert(truth.end(), {density, modulus});
  }
  const Dataset data = made_data(arm, truth_with(truth[0], truth[1], density, modulus), random);
  const FitSpec spec = spec_of(arm);
  const FitResult fitted = fit(make_model(spec, {data}), gather({data}, spec));
  if (!fitted.usable) return {};
  PosteriorOptions options;
  options.seed = seed + stream;
  options.threads = threads;
  const PosteriorResult found = sample_posterior(fit_alternatives(fitted), {}, options);
  if (!found.available()) return {};
  std::vector<double> ranks;
  std::size_t slot = 0;
  for (const double value : truth) {
    while (!fitted.model.slots[slot].moves()) ++slot;
    double rank = 0.0;
    const std::size_t step = found.draws.size() / (rank_draws + 1);
    for (std::size_t k = 1; k <= rank_draws; ++k) {
      rank += found.draws[k * step][slot] < value ? 1.0 : 0.0;
    }
    ranks.push_back(rank);
    ++slot;
  }
  return ranks;
}

/// The two-sided probabilities of `count` of `sets` data sets at rank i or less.
double tail_probability(int count, int sets, std::size_t i) {
  const double p = static_cast<double>(i + 1) / (rank_draws + 1);
  const auto n = static_cast<unsigned>(sets);
  const auto k = static_cast<unsigned>(count);
  const double below = gsl_cdf_binomial_P(k, p, n);
  const double above = k == 0 ? 1.0 : gsl_cdf_binomial_Q(k - 1, p, n);
  return std::min(1.0, 2.0 * std::min(below, above));
}

std::vector<int> counts_below(const std::vector<int>& ranks) {
  std::vector<int> counts(rank_draws, 0);
  for (const int rank : ranks) {
    for (std::size_t i = static_cast<std::size_t>(rank); i < counts.size(); ++i) ++counts[i];
  }
  return counts;
}

double least_probability(const std::vector<int>& ranks) {
  const std::vector<int> counts = counts_below(ranks);
  double least = 1.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    least = std::min(least, tail_probability(counts[i], static_cast<int>(ranks.size()), i));
  }
  return least;
}

/// The share of ranks 5 to 94, 90 of 100: of equal-tailed 90 % intervals that hold the truth.
double share_within(const std::vector<int>& ranks) {
  const auto within =
      std::count_if(ranks.begin(), ranks.end(), [](int rank) { return rank >= 5 && rank < 95; });
  return static_cast<double>(within) / static_cast<double>(ranks.size());
}

std::string title_of(RankArm arm) {
  std::string words = words_of(to_string(arm));
  words.front() = static_cast<char>(std::toupper(words.front()));
  return words;
}

}  // namespace

Dataset fluorescein_on_molybdenum() {
  Dataset data;
  data.id = "simulated";
  data.provenance = Provenance::synthetic;
  data.system.particle = {"ammonium fluorescein", 1350.0, 1.2e9, 0.33, std::nullopt};
  data.system.surface = {"molybdenum", 0.0, 320e9, 0.31, std::nullopt};
  data.system.reference_diameter = 4.9e-6;
  return data;
}

RankStudy study_ranks(int sets, std::uint64_t seed, int threads, const std::string& kept) {
  RankStudy study;
  study.sets = sets;
  study.seed = seed;
  // Within the folder of a key of all sources; the file has one of what else decides a digit.
  KeptRows rows(kept.empty() ? std::filesystem::path{}
                             : std::filesystem::path(kept) / "posterior-ranks.jsonl",
                fmt::format("ranks {} {}", sets, seed));
  const Pieces pieces = {
      "posteriors", rank_arms.size() * static_cast<std::size_t>(sets), threads,
      [&](std::size_t piece) {
        const auto count = static_cast<std::size_t>(sets);
        return row_json(ranks_of(rank_arms[piece / count], piece % count, seed, 1));
      }};
  resumable(rows, [&] {
    resumable(pieces, rows);
    return 0;
  });
  std::size_t piece = 0;
  for (const RankArm arm : rank_arms) {
    const std::vector<std::string> names = rank_parameters(arm);
    const std::size_t first = study.rows.size();
    for (const std::string& name : names) study.rows.push_back({arm, name, 0, {}});
    for (int i = 0; i < sets; ++i) {
      const std::vector<double> ranks = row_numbers(*rows.find(piece++));
      for (std::size_t k = 0; k < names.size(); ++k) {
        RankRow& row = study.rows[first + k];
        if (ranks.empty()) {
          ++row.unsettled;
        } else {
          row.ranks.push_back(static_cast<int>(ranks[k]));
        }
      }
    }
  }
  return study;
}

RankBand rank_band(int sets) {
  constexpr int samples = 2000;
  RankBand band;
  for (int s = 0; s < samples; ++s) {
    RandomStream random(1, rank_purpose, (std::uint64_t{1} << 40) + static_cast<unsigned>(s));
    std::vector<int> ranks;
    for (int i = 0; i < sets; ++i) {
      ranks.push_back(static_cast<int>(random.below(rank_draws + 1)));
    }
    band.least.push_back(least_probability(ranks));
  }
  std::sort(band.least.begin(), band.least.end());
  const double allowed = band.least[samples / 20];
  for (std::size_t i = 0; i < rank_draws; ++i) {
    int low = 0, high = sets;
    while (tail_probability(low, sets, i) < allowed) ++low;
    while (tail_probability(high, sets, i) < allowed) --high;
    band.lower.push_back(static_cast<double>(low) / sets);
    band.upper.push_back(static_cast<double>(high) / sets);
  }
  return band;
}

double rank_p_value(const std::vector<int>& ranks, const RankBand& band) {
  const auto at = std::upper_bound(band.least.begin(), band.least.end(), least_probability(ranks));
  return static_cast<double>(at - band.least.begin()) / static_cast<double>(band.least.size());
}

plot::Picture picture_of(const RankStudy& study) {
  plot::Picture picture;
  picture.name = "posterior-ranks";
  picture.title = "Ranks of the truth among draws of the posterior";
  picture.width = 900;
  picture.height = 700;
  const RankBand band = rank_band(study.sets);
  std::vector<double> x;
  for (int i = 0; i < rank_draws; ++i) x.push_back((i + 1.0) / (rank_draws + 1));
  const auto above = [&x](std::vector<double> shares) {
    for (std::size_t i = 0; i < x.size(); ++i) shares[i] -= x[i];
    return shares;
  };
  for (std::size_t a = 0; a < rank_arms.size(); ++a) {
    plot::Plot& panel = picture.plots.emplace_back();
    const double left = a % 2 == 0 ? 80.0 : 540.0;
    const double bottom = a < 2 ? 440.0 : 100.0;
    panel.frame = plot::Frame{left, left + 340.0, bottom, bottom + 200.0};
    panel.key = plot::KeyPlace::below;
    panel.heading = title_of(rank_arms[a]);
    panel.x = {"rank of the truth"};
    panel.y = {"share of ranks below, less the rank"};
    panel.x.set_range({0.0, 1.0});
    panel.y.set_range({-0.15, 0.15});
    plot::Band uniform;
    uniform.x = x;
    uniform.lower = above(band.lower);
    uniform.upper = above(band.upper);
    uniform.fill.colour = std::string(plot::grey);
    uniform.fill.opacity = 0.2;
    uniform.name = "95 % of uniform ranks";
    panel.layers.emplace_back(std::move(uniform));
    std::size_t k = 0;
    for (const RankRow& row : study.rows) {
      if (row.arm != rank_arms[a]) continue;
      std::vector<double> shares;
      for (const int count : counts_below(row.ranks)) {
        shares.push_back(count / static_cast<double>(row.ranks.size()));
      }
      plot::Line line;
      line.x = x;
      line.y = above(std::move(shares));
      line.stroke.colour = plot::marker(k++).colour;
      line.name = row.parameter;
      panel.layers.emplace_back(std::move(line));
    }
  }
  return picture;
}

Document page_of(const RankStudy& study) {
  Document page;
  page.heading = "Does the posterior hold what it promises?";
  page.foreword = {Paragraph{say(
      "Simulation-based calibration (Talts et al. 2018). In each of {} data sets the parameters "
      "are "
      "drawn from the prior, and impacts with these parameters are simulated by code that shares "
      "nothing with the fitter: two diameters at nine velocities. The rank of the truth among {} "
      "draws of the posterior is then uniform if the posterior is right. p is the share of uniform "
      "samples that are as far from uniform anywhere (simultaneous bands, Saeilynoja et al. "
      "2022).",
      study.sets, rank_draws)}};
  using Row = const RankRow&;
  const Table table = study_table<RankRow>(
      study.rows,
      {{"data", [](Row row) { return word_cell(title_of(row.arm)); }, true},
       {"parameter", [](Row row) { return word_cell(row.parameter); }, true},
       {"data sets", [](Row row) { return count_cell(row.ranks.size()); }},
       {"without a posterior", [](Row row) { return word_cell(std::to_string(row.unsettled)); }},
       {"90 % intervals that hold the truth",
        [](Row row) {
          return word_cell(fmt::format("{:.1f} %", 100.0 * share_within(row.ranks)));
        }},
       {"p", [](Row row) {
          const RankBand band = rank_band(static_cast<int>(row.ranks.size()));
          return word_cell(fmt::format("{:.3f}", rank_p_value(row.ranks, band)));
        }}});
  page.sections = {{"ranks", "Ranks", {}, {table}}};
  append(page.sections.back().blocks, stamp_blocks(study.stamp));
  return page;
}

}  // namespace recoil
