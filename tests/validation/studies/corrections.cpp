#include "validation/studies/corrections.hpp"

#include <algorithm>
#include <cmath>

#include "core/files.hpp"
#include "data/datapackage_writer.hpp"
#include "estimate/capture_velocity.hpp"
#include "estimate/fit.hpp"
#include "experiment/pairing_files.hpp"
#include "validation/recipe/paired_points.hpp"
#include "validation/recipe/reconstruction.hpp"

namespace recoil {
namespace {

bool leaves_out(Correction row, Correction correction) {
  return row == correction || row == Correction::all_left_out;
}

Averages averages_without(Correction left_out, const PassageTable& table, PairingOptions pairing,
                          const AverageOptions& averaging) {
  pairing.keep_later = leaves_out(left_out, Correction::second_impacts);
  PairingResult pairs = pair_passages(table.passages, pairing);
  if (leaves_out(left_out, Correction::probe_plane)) {
    for (Impact& impact : pairs.impacts) {
      impact.incident = table.passages[impact.down].velocity;
      impact.rebound = -table.passages[impact.up].velocity;
      impact.restitution = impact.rebound / impact.incident;
    }
    for (Unpaired& lone : pairs.unpaired) lone.incident = table.passages[lone.down].velocity;
  }
  return average(table.passages, table.series, pairs, averaging);
}

/// Mean of e - truth over the rebounds of the points that `chosen` takes.
template <class Chosen>
std::optional<double> mean_error(const KnownPassages& events, const Averages& averages,
                                 const Chosen& chosen) {
  double sum = 0.0;
  double rebounds = 0.0;
  for (const PointMean& point : averages.points) {
    if (point.rebounds == 0 || !chosen(point.velocity)) continue;
    const auto n = static_cast<double>(point.rebounds);
    sum += n * (point.restitution - events.restitution(point.diameter, point.velocity));
    rebounds += n;
  }
  if (rebounds == 0.0) return std::nullopt;
  return sum / rebounds;
}

std::vector<std::optional<double>> errors_by_velocity(const KnownPassages& events,
                                                      const Averages& averages) {
  const auto nearest = [&](double velocity) {
    const auto distance = [&](double v) { return std::abs(std::log(v / velocity)); };
    return std::min_element(events.velocities.begin(), events.velocities.end(),
                            [&](double a, double b) { return distance(a) < distance(b); });
  };
  std::vector<std::optional<double>> errors;
  for (auto it = events.velocities.begin(); it != events.velocities.end(); ++it) {
    errors.push_back(mean_error(events, averages, [&](double v) { return nearest(v) == it; }));
  }
  return errors;
}

void fit_points(const FitSpec& spec, const Dataset& like, const KnownPassages& events,
                const Averages& averages, CorrectionRow& row) {
  const Dataset dataset = parse_dataset(package_json(stated_system(like.folder), like.id,
                                                     like.provenance, events.table.file, "a study"),
                                        points_csv(averages), like.folder);
  const FitResult fitted = fit(make_model(spec, {dataset}), gather({dataset}, spec));
  row.usable = fitted.usable;
  if (!fitted.usable) return;
  const std::size_t h = fitted.model.slot_C_H[0];
  const std::size_t a = fitted.model.slot_C_A[0];
  row.C_H = fitted.theta[h];
  row.C_H_sd = fitted.std_error[h];
  row.C_A = fitted.theta[a];
  row.C_A_sd = fitted.std_error[a];
  row.capture_velocity = capture_velocity(fitted.model, fitted.theta, 0, events.diameter).value;
  row.rmse = fitted.rmse;
}

}  // namespace

CorrectionStudy study_corrections(const FitSpec& spec, const Dataset& like,
                                  const KnownPassages& events, const PairingOptions& pairing,
                                  const AverageOptions& averaging,
                                  std::span<const Correction> ways) {
  CorrectionStudy study;
  study.passages = events.table.passages.size();
  study.rebounds_per_velocity = events.rebounds_per_velocity;
  study.size_classes =
      averaging.size_edges.size() > 2 ? averaging.size_edges.size() - 1 : averaging.size_classes;
  study.velocities = events.velocities;
  study.diameter = events.diameter;
  study.C_H = events.C_H;
  study.C_A = events.C_A;
  study.capture_velocity = events.capture_velocity;
  for (const Correction left_out : ways) {
    CorrectionRow row;
    row.left_out = left_out;
    Averages averages = averages_without(left_out, events.table, pairing, averaging);
    row.captured = averages.captured;
    if (leaves_out(left_out, Correction::survivors)) {
      row.captured = 0;
      for (PointMean& point : averages.points) point.captured = 0;
      std::erase_if(averages.points, [](const PointMean& point) { return point.rebounds == 0; });
    }
    row.points = averages.points.size();
    row.error_slow = mean_error(events, averages, [](double v) { return v < slow_impacts; });
    row.error_fast = mean_error(events, averages, [](double v) { return v >= slow_impacts; });
    row.error = errors_by_velocity(events, averages);
    fit_points(spec, like, events, averages, row);
    study.rows.push_back(std::move(row));
  }
  return study;
}

KnownPassages known_passages(const Recipe& recipe, int times) {
  const std::map<std::string, double> truth = true_parameters(recipe);
  KnownPassages known;
  known.table = recipe_passages(recipe, times);
  known.rebounds_per_velocity = static_cast<double>(times) * recipe.noise.events;
  known.velocities = recipe.series.front().velocities;
  known.diameter = recipe.series.front().diameter;
  known.C_H = truth.at("C_H");
  known.C_A = truth.at("C_A");
  known.capture_velocity = true_capture_velocity(recipe.truth, known.diameter);
  known.restitution = [law = recipe.truth](double diameter, double velocity) {
    return true_restitution(law, diameter, velocity);
  };
  return known;
}

std::vector<CorrectionStudy> study_recipe(const FitSpec& spec, const Recipe& recipe,
                                          const Dataset& like, int many_times,
                                          std::size_t many_classes) {
  if (!recipe.pairing || true_parameters(recipe).empty()) return {};
  const PairingOptions pairing = recipe_pairing(recipe);
  AverageOptions averaging = recipe_averaging(recipe);
  std::vector<CorrectionStudy> studies;
  studies.push_back(study_corrections(spec, like, known_passages(recipe, 1), pairing, averaging));
  averaging.per_bin *= static_cast<std::size_t>(many_times);
  averaging.per_bin /= many_classes;
  averaging.size_classes = many_classes;
  averaging.mean_diameter = false;
  studies.push_back(
      study_corrections(spec, like, known_passages(recipe, many_times), pairing, averaging));
  return studies;
}

}  // namespace recoil
