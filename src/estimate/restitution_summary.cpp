#include "estimate/restitution_summary.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/numerics.hpp"
#include "core/statistics.hpp"
#include "estimate/reweighting.hpp"

namespace recoil {
namespace {

constexpr double tail = 0.5 * (1.0 - summary_level);
constexpr double lack_of_fit_level = 0.05;
constexpr double size_factor = 1.2;  // diameters within it are one size

/// One point that rebounded.
struct Reading {
  double e = 0.0;
  double sd = 0.0;  ///< stated; 0: none
  double velocity = 0.0;
  std::size_t series = 0;  ///< index among all series of all datasets
  std::size_t place = 0;   ///< index of its setting among all settings
};

bool rebounded(const ImpactPoint& point) {
  return !point.all_captured() && point.restitution > 0.0;
}

/// The median of the stated errors of e; nullopt if none is stated.
std::optional<double> usual_error(const std::vector<Dataset>& datasets) {
  std::vector<double> stated;
  for (const Dataset& dataset : datasets) {
    for (const ImpactPoint& point : dataset.points) {
      if (rebounded(point) && point.restitution_sd) stated.push_back(*point.restitution_sd);
    }
  }
  if (stated.empty()) return std::nullopt;
  return median(std::move(stated));
}

/// A series at one diameter.
struct Group {
  std::size_t dataset = 0;
  std::size_t series = 0;
  double diameter = 0.0;
  std::map<std::tuple<std::string, double>, std::vector<const ImpactPoint*>> settings;
};

std::vector<Group> groups_of(const std::vector<Dataset>& datasets) {
  std::map<std::tuple<std::size_t, std::size_t, double>, Group> groups;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    for (const ImpactPoint& point : datasets[d].points) {
      if (!rebounded(point)) continue;
      Group& group = groups[{d, point.series, point.diameter}];
      group.dataset = d;
      group.series = point.series;
      group.diameter = point.diameter;
      const bool named = !point.setting.empty();
      group.settings[{point.setting, named ? 0.0 : point.incident_velocity}].push_back(&point);
    }
  }
  std::vector<Group> found;
  for (auto& [key, group] : groups) found.push_back(std::move(group));
  return found;
}

/// @param usual error of a point that states none
RestitutionMean mean_of(const Group& group, const std::vector<const ImpactPoint*>& points,
                        std::optional<double> usual) {
  RestitutionMean found;
  found.dataset = group.dataset;
  found.series = group.series;
  found.diameter = group.diameter;
  std::vector<double> e;
  double stated = 0.0;                   // sum of variances
  std::map<std::string, double> shared;  // by setting: sum of the shared errors of e
  for (const ImpactPoint* point : points) {
    e.push_back(point->restitution);
    stated += std::pow(point->restitution_sd.value_or(usual.value_or(0.0)), 2);
    shared[point->setting] +=
        point->restitution * point->setting_velocity_sd.value_or(0.0) / point->incident_velocity;
  }
  const auto n = static_cast<double>(e.size());
  found.points = static_cast<int>(e.size());
  found.value = mean(e);
  double of_settings = 0.0;
  for (const auto& [setting, error] : shared) of_settings += error * error;
  const double normal = gsl_cdf_ugaussian_Qinv(tail);
  double half = usual ? normal * std::sqrt(stated + of_settings) / n : 0.0;
  const double scatter = standard_deviation(e);
  if (scatter > least_noise) {
    half = std::max(half, std::hypot(gsl_cdf_tdist_Qinv(tail, n - 1.0) * scatter / std::sqrt(n),
                                     normal * std::sqrt(of_settings) / n));
  }
  if (half > 0.0) {
    found.interval = {found.value - half, found.value + half};
  } else {
    found.why = e.size() > 1 ? "the readings are equal, and no error is stated"
                             : "one reading, and no error is stated";
  }
  return found;
}

double mean_velocity(const std::vector<const ImpactPoint*>& points) {
  double sum = 0.0;
  for (const ImpactPoint* point : points) sum += point->incident_velocity;
  return sum / static_cast<double>(points.size());
}

void add_means(const Group& group, std::optional<double> usual,
               std::vector<RestitutionMean>& means) {
  std::vector<const ImpactPoint*> all;
  bool repeated = false;
  for (const auto& [key, points] : group.settings) {
    all.insert(all.end(), points.begin(), points.end());
    repeated = repeated || points.size() > 1;
  }
  means.push_back(mean_of(group, all, usual));
  if (!repeated || group.settings.size() < 2) return;
  for (const auto& [key, points] : group.settings) {
    RestitutionMean of_setting = mean_of(group, points, usual);
    of_setting.setting = std::get<0>(key);
    of_setting.velocity = mean_velocity(points);
    means.push_back(std::move(of_setting));
  }
}

RestitutionRange::End end_of(const std::vector<const ImpactPoint*>& points) {
  RestitutionRange::End end{mean_velocity(points)};
  double variance = 0.0;
  bool stated = true;
  for (const ImpactPoint* point : points) {
    end.value += point->restitution;
    variance += std::pow(point->restitution_sd.value_or(0.0), 2);
    stated = stated && point->restitution_sd.has_value();
  }
  const auto n = static_cast<double>(points.size());
  end.value /= n;
  end.error = stated ? std::sqrt(variance) / n : 0.0;
  return end;
}

std::vector<RestitutionRange> ranges_of(const std::vector<Group>& groups) {
  std::map<std::pair<std::size_t, double>, RestitutionRange> sizes;
  for (const Group& group : groups) {
    RestitutionRange& range = sizes[{group.dataset, group.diameter}];
    range.dataset = group.dataset;
    range.diameter = group.diameter;
    for (const auto& [key, points] : group.settings) {
      const RestitutionRange::End end = end_of(points);
      const bool first = range.settings++ == 0;
      if (first || end.velocity < range.slowest.velocity) range.slowest = end;
      if (first || end.velocity > range.fastest.velocity) range.fastest = end;
      if (first || end.value > range.largest.value) range.largest = end;
    }
  }
  std::vector<RestitutionRange> found;
  for (const auto& [key, range] : sizes) found.push_back(range);
  return found;
}

/// Are they different series of one size?
bool comparable(const Group& a, const Group& b) {
  const bool other = a.dataset != b.dataset || a.series != b.series;
  return other && std::max(a.diameter, b.diameter) < size_factor * std::min(a.diameter, b.diameter);
}

/// e = a_series + b log10 V, and c (log10 V)^2 in degree 2, by weighted least squares.
class Line {
 public:
  Line(const std::vector<Reading>& readings, std::size_t series, Eigen::Index degree = 1)
      : stated_(std::all_of(readings.begin(), readings.end(),
                            [](const Reading& r) { return r.sd > 0.0; })) {
    const auto n = static_cast<Eigen::Index>(readings.size());
    const auto s = static_cast<Eigen::Index>(series);
    Eigen::MatrixXd X = Eigen::MatrixXd::Zero(n, s + degree);
    Eigen::VectorXd y(n);
    std::vector<double> middle(series, 0.0), count(series, 0.0);
    for (const Reading& r : readings) {
      middle[r.series] += std::log10(r.velocity);
      count[r.series] += 1.0;
    }
    double spread = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      const Reading& r = readings[static_cast<std::size_t>(i)];
      const double weight = stated_ ? 1.0 / r.sd : 1.0;
      const double log_v = std::log10(r.velocity);
      spread = std::max(spread, std::abs(log_v - middle[r.series] / count[r.series]));
      X(i, static_cast<Eigen::Index>(r.series)) = weight;
      for (Eigen::Index k = 1; k <= degree; ++k) {
        X(i, s + k - 1) = weight * std::pow(log_v, static_cast<double>(k));
      }
      y(i) = weight * r.e;
    }
    sloped_ = spread > 1e-9;
    if (!sloped_) X.conservativeResize(Eigen::NoChange, s);
    columns_ = X.cols();
    dof_ = static_cast<int>(n - columns_);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(X);
    solvable_ = dof_ >= 0 && qr.rank() == X.cols();
    if (!solvable_) return;
    coefficients_ = qr.solve(y);
    inverse_ = (X.transpose() * X).inverse();
    rest_ = y - X * coefficients_;
    variance_ = dof_ > 0 ? rest_.squaredNorm() / dof_ : 0.0;
    const double unit = stated_ ? 1.0 : least_noise;
    scatters_ = dof_ > 0 && (stated_ || variance_ > unit * unit);
  }

  bool stated() const { return stated_; }
  bool sloped() const { return sloped_; }
  int dof() const { return dof_; }
  double square() const { return rest_.squaredNorm(); }
  double value(const Eigen::VectorXd& contrast) const { return contrast.dot(coefficients_); }
  Eigen::Index columns() const { return columns_; }
  /// Is an error known, stated or from the scatter?
  bool has_errors() const { return solvable_ && (stated_ || scatters_); }
  std::string missing() const {
    return dof_ < 1 ? "as many unknowns as readings, and no error is stated"
                    : "the readings do not scatter, and no error is stated";
  }

  std::array<double, 2> interval(const Eigen::VectorXd& contrast) const {
    const double error = std::sqrt(contrast.dot(inverse_ * contrast));
    double half = stated_ ? gsl_cdf_ugaussian_Qinv(tail) * error : 0.0;
    if (dof_ > 0) {
      half = std::max(half, gsl_cdf_tdist_Qinv(tail, dof_) * error * std::sqrt(variance_));
    }
    return {value(contrast) - half, value(contrast) + half};
  }

  /// p-value of the hypothesis that all `contrasts` (columns) are 0.
  double p_value(const Eigen::MatrixXd& contrasts) const {
    const Eigen::VectorXd seen = contrasts.transpose() * coefficients_;
    const double square =
        seen.dot((contrasts.transpose() * inverse_ * contrasts).ldlt().solve(seen));
    const auto count = static_cast<double>(contrasts.cols());
    double p = stated_ ? gsl_cdf_chisq_Q(square, count) : 0.0;
    if (dof_ > 0 && variance_ > 0.0) {
      p = std::max(p, gsl_cdf_fdist_Q(square / count / variance_, count, dof_));
    }
    return p;
  }

 private:
  bool stated_ = false, sloped_ = false, solvable_ = false, scatters_ = false;
  Eigen::Index columns_ = 0;
  int dof_ = 0;
  double variance_ = 0.0;
  Eigen::VectorXd coefficients_, rest_;
  Eigen::MatrixXd inverse_;
};

/// The mean reading of every setting.
std::vector<Reading> means_of_places(const std::vector<Reading>& readings) {
  std::map<std::size_t, std::vector<Reading>> places;
  for (const Reading& r : readings) places[r.place].push_back(r);
  std::vector<Reading> means;
  for (const auto& [place, own] : places) {
    Reading sum = own.front();
    sum.sd = 0.0;  // the scatter of the means decides, not the stated errors
    sum.e = sum.velocity = 0.0;
    for (const Reading& r : own) {
      sum.e += r.e / static_cast<double>(own.size());
      sum.velocity += r.velocity / static_cast<double>(own.size());
    }
    means.push_back(sum);
  }
  return means;
}

/// Do the means of settings scatter more about the line than the readings within a setting explain?
bool places_scatter(const std::vector<Reading>& readings, const Line& line) {
  std::map<std::size_t, std::array<double, 4>> sums;  // w, w e, w e^2, count
  for (const Reading& r : readings) {
    const double w = line.stated() ? 1.0 / (r.sd * r.sd) : 1.0;
    auto& own = sums[r.place];
    own[0] += w;
    own[1] += w * r.e;
    own[2] += w * r.e * r.e;
    own[3] += 1.0;
  }
  double within = 0.0, freedom = 0.0;
  for (const auto& [place, own] : sums) {
    within += std::max(0.0, own[2] - own[1] * own[1] / own[0]);
    freedom += own[3] - 1.0;
  }
  const double between = line.dof() - freedom;
  if (!(freedom >= 1.0) || !(between >= 1.0)) return false;
  const double square = std::max(0.0, line.square() - within) / between;
  double p = line.stated() ? gsl_cdf_chisq_Q(square * between, between) : 0.0;
  if (within > 0.0) p = std::max(p, gsl_cdf_fdist_Q(square / (within / freedom), between, freedom));
  return p < lack_of_fit_level;
}

}  // namespace

bool RestitutionRange::peaks() const {
  return std::ranges::all_of(std::array{slowest, fastest}, [&](const End& end) {
    const bool known = end.error > 0.0 && largest.error > 0.0;
    return known && largest.value - end.value > 2.0 * std::hypot(end.error, largest.error);
  });
}

RestitutionSummary summarise_restitution(const std::vector<Dataset>& datasets, bool adhesion) {
  gsl_errors_are_values();
  RestitutionSummary summary;
  std::vector<Reading> readings;
  std::vector<std::size_t> place_in_means;  // [series] index into summary.means
  std::size_t place = 0;
  const std::vector<Group> groups = groups_of(datasets);
  const std::optional<double> usual = usual_error(datasets);
  for (const Group& group : groups) {
    place_in_means.push_back(summary.means.size());
    for (const auto& [key, points] : group.settings) {
      for (const ImpactPoint* point : points) {
        readings.push_back({point->restitution, point->restitution_sd.value_or(usual.value_or(0.0)),
                            point->incident_velocity, place_in_means.size() - 1, place});
        if (usual && !point->restitution_sd) ++summary.without_error;
      }
      ++place;
    }
    add_means(group, usual, summary.means);
  }
  summary.ranges = ranges_of(groups);
  summary.rebounds = readings.size();
  const std::size_t series = groups.size();
  summary.several_series = series > 1;
  if (readings.empty() || adhesion) {
    summary.velocity.why = summary.series.why =
        readings.empty() ? "no sphere rebounded"
                         : "with adhesion e rises steeply from capture and then falls";
    return summary;
  }
  const auto [slow, fast] = std::minmax_element(
      readings.begin(), readings.end(),
      [](const Reading& one, const Reading& other) { return one.velocity < other.velocity; });
  summary.velocities = {slow->velocity, fast->velocity};
  const auto [low, high] =
      std::minmax_element(readings.begin(), readings.end(),
                          [](const Reading& one, const Reading& other) { return one.e < other.e; });
  summary.values = {low->e, high->e};
  const bool scattered = places_scatter(readings, Line(readings, series));
  const std::vector<Reading> used = scattered ? means_of_places(readings) : readings;
  const Line line(used, series);
  const auto s = static_cast<Eigen::Index>(series);
  const auto assess = [&](const Eigen::VectorXd& contrast, const Eigen::MatrixXd& all,
                          TestedEffect& effect) {
    if (!line.has_errors()) {
      effect.why = line.missing();
      return;
    }
    effect.value = line.value(contrast);
    effect.interval = line.interval(contrast);
    effect.p_value = line.p_value(all);
  };
  if (line.sloped()) {
    const Eigen::VectorXd slope = Eigen::VectorXd::Unit(s + 1, s);
    assess(slope, slope, summary.velocity);
    const Line bent(used, series, 2);
    if (bent.has_errors() && bent.dof() > 0) {
      summary.bend = bent.p_value(Eigen::MatrixXd::Identity(s + 2, s + 2).rightCols(2));
    }
  } else {
    summary.velocity.why = series > 1 ? "one velocity in each series" : "one velocity";
  }
  // One difference per series, from the first one of its size: these are independent.
  std::vector<Eigen::VectorXd> differences;
  Eigen::VectorXd largest = Eigen::VectorXd::Zero(line.columns());
  for (std::size_t b = 0; b < series; ++b) {
    bool first = true;
    for (std::size_t a = 0; a < b; ++a) {
      if (!comparable(groups[a], groups[b])) continue;
      Eigen::VectorXd difference = Eigen::VectorXd::Zero(line.columns());
      difference(static_cast<Eigen::Index>(a)) = 1.0;
      difference(static_cast<Eigen::Index>(b)) = -1.0;
      if (std::exchange(first, false)) differences.push_back(difference);
      if (!line.has_errors()) continue;
      const double value = line.value(difference);
      if (std::abs(value) < line.value(largest)) continue;
      largest = value < 0.0 ? Eigen::VectorXd(-difference) : difference;
      summary.most_different = {place_in_means[value < 0.0 ? b : a],
                                place_in_means[value < 0.0 ? a : b]};
    }
  }
  if (differences.empty()) {
    summary.series.why = series < 2 ? "one series" : "no two series have one size";
    return summary;
  }
  Eigen::MatrixXd contrasts(line.columns(), static_cast<Eigen::Index>(differences.size()));
  for (std::size_t k = 0; k < differences.size(); ++k) {
    contrasts.col(static_cast<Eigen::Index>(k)) = differences[k];
  }
  assess(largest, contrasts, summary.series);
  return summary;
}

}  // namespace recoil
