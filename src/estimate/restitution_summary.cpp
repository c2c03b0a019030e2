#include "estimate/restitution_summary.hpp"

#include <gsl/gsl_cdf.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/numbers.hpp"
#include "core/numerics.hpp"
#include "core/statistics.hpp"
#include "core/units.hpp"
#include "estimate/instant_errors.hpp"
#include "estimate/reweighting.hpp"

namespace recoil {
namespace {

constexpr double tail = 0.5 * (1.0 - summary_level);
constexpr double lack_of_fit_level = 0.05;
constexpr double size_factor = 1.2;  // diameters within it are one size
// A standard deviation from four degrees of freedom is known within a factor of 2.9 (95 %).
constexpr std::size_t fewest_launches = 5;
constexpr std::size_t none = static_cast<std::size_t>(-1);

/// One point that rebounded.
struct Reading {
  const ImpactPoint* point = nullptr;
  double e = 0.0;
  double sd = 0.0;  ///< stated; 0: none
  double velocity = 0.0;
  std::string_view setting;   ///< its name; empty: none is stated
  std::size_t series = 0;     ///< index among all series of all datasets
  std::size_t place = 0;      ///< index of its setting among all settings
  std::size_t launch = none;  ///< index among all launches
  LinkedBounce linked;        ///< its place in a run of bounces that share instants
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

using Readings = std::span<const Reading>;

/// Successive readings with the same key(reading) each.
template <class Key>
std::vector<Readings> runs_of(Readings readings, const Key& key) {
  std::vector<Readings> runs;
  for (std::size_t first = 0, last = 0; first < readings.size(); first = last) {
    while (last < readings.size() && key(readings[last]) == key(readings[first])) ++last;
    runs.push_back(readings.subspan(first, last - first));
  }
  return runs;
}

/// What readings of one setting have in common: its name, or their velocity.
std::pair<std::string_view, double> setting_of(const Reading& reading) {
  return {reading.setting, reading.setting.empty() ? reading.velocity : 0.0};
}

/// A series at one size.
struct Group {
  std::size_t dataset = 0;
  std::size_t series = 0;
  std::size_t size = 0;            ///< index of the size within its dataset
  double diameter = 0.0;           ///< mean [m]
  std::vector<Reading> readings;   ///< by setting
  std::vector<Readings> settings;  ///< parts of `readings`
};

/// The number of the size of every diameter of a dataset.
std::map<double, std::size_t> sizes_of(const Dataset& dataset) {
  std::map<double, std::size_t> sizes;
  for (const ImpactPoint& point : dataset.points) sizes[point.diameter] = 0;
  double first = 0.0;
  std::size_t size = none;
  for (auto& [diameter, number] : sizes) {
    if (size == none || diameter > size_factor * first) {
      first = diameter;
      ++size;
    }
    number = size;
  }
  return sizes;
}

/// @param usual error of a point that states none
std::vector<Group> groups_of(const std::vector<Dataset>& datasets, std::optional<double> usual) {
  std::map<std::tuple<std::size_t, std::size_t, std::size_t>, Group> groups;
  std::map<std::tuple<std::size_t, std::size_t, std::string_view>, std::size_t> launches;
  std::size_t runs = 0;
  for (std::size_t d = 0; d < datasets.size(); ++d) {
    const std::map<double, std::size_t> sizes = sizes_of(datasets[d]);
    const std::vector<LinkedBounce> linked = linked_bounces(datasets[d]);
    std::size_t own_runs = 0;
    const bool launched = std::ranges::any_of(
        datasets[d].points, [](const ImpactPoint& point) { return !point.launch.empty(); });
    for (std::size_t i = 0; i < linked.size(); ++i) {
      const ImpactPoint& point = datasets[d].points[i];
      if (!rebounded(point)) continue;
      const std::size_t size = sizes.at(point.diameter);
      Group& group = groups[{d, point.series, size}];
      group.dataset = d;
      group.series = point.series;
      group.size = size;
      Reading reading;
      reading.point = &point;
      reading.e = point.restitution;
      reading.sd = point.restitution_sd.value_or(usual.value_or(0.0));
      reading.velocity = point.incident_velocity;
      reading.setting = point.setting;
      if (!point.launch.empty()) {
        reading.launch =
            launches.try_emplace({d, point.series, point.launch}, launches.size()).first->second;
      } else if (launched) {
        reading.launch = none - 1 - i;  // one of its own
      }
      if (linked[i].launch != Observation::no_launch) {
        reading.linked = {runs + linked[i].launch, linked[i].bounce};
        own_runs = std::max(own_runs, linked[i].launch + 1);
      }
      group.readings.push_back(reading);
    }
    runs += own_runs;
  }
  std::vector<Group> found;
  for (auto& [key, group] : groups) {
    std::ranges::stable_sort(group.readings, {}, setting_of);
    group.settings = runs_of(group.readings, setting_of);
    double count = 0.0;
    for (const Reading& reading : group.readings) {
      count += 1.0;
      group.diameter += (reading.point->diameter - group.diameter) / count;
    }
    found.push_back(std::move(group));
  }
  return found;
}

/// The launches of readings; 0 unless all have one.
std::size_t count_launches(Readings readings) {
  std::set<std::size_t> launches;
  for (const Reading& r : readings) {
    if (r.launch == none) return 0;
    launches.insert(r.launch);
  }
  return launches.size();
}

/// Variance of the sum of e over readings from their stated errors.
double variance_of_sum(Readings readings) {
  double sum = 0.0;
  std::map<std::pair<std::size_t, std::size_t>, double> instants;  // loads by run and instant
  for (const Reading& r : readings) {
    if (r.linked.launch == Observation::no_launch) {
      sum += r.sd * r.sd;
      continue;
    }
    const std::array<double, 3> part = instant_coefficients(r.e);
    for (std::size_t k = 0; k < part.size(); ++k) {
      instants[{r.linked.launch, r.linked.bounce + k}] += r.sd * part[k];
    }
  }
  for (const auto& [instant, load] : instants) sum += load * load;
  return sum;
}

RestitutionMean mean_of(const Group& group, Readings readings) {
  RestitutionMean found;
  found.dataset = group.dataset;
  found.series = group.series;
  found.diameter = group.diameter;
  std::vector<double> e;
  std::map<std::string, double> shared;  // by setting: sum of the shared errors of e
  for (const Reading& r : readings) {
    e.push_back(r.e);
    const double of_setting = r.point->setting_velocity_sd.value_or(0.0);
    if (of_setting > 0.0) shared[r.point->setting] += r.e * of_setting / r.velocity;
  }
  const auto n = static_cast<double>(e.size());
  const std::size_t launches = count_launches(readings);
  found.points = static_cast<int>(e.size());
  found.launches = static_cast<int>(launches);
  found.value = mean(e);
  double of_settings = 0.0;
  for (const auto& [setting, error] : shared) of_settings += error * error;
  const double normal = gsl_cdf_ugaussian_Qinv(tail);
  const double stated = std::sqrt(variance_of_sum(readings));
  double half = stated > 0.0 ? normal * std::hypot(stated, std::sqrt(of_settings)) / n : 0.0;
  if (standard_deviation(e) > least_noise) {
    double error = standard_deviation(e) / std::sqrt(n);
    double freedom = n - 1.0;
    if (launches >= fewest_launches) {
      std::map<std::size_t, double> sums;
      for (const Reading& r : readings) sums[r.launch] += r.e - found.value;
      double square = 0.0;
      for (const auto& [launch, sum] : sums) square += sum * sum;
      freedom = static_cast<double>(launches) - 1.0;
      error = std::sqrt(square * (freedom + 1.0) / freedom) / n;
    }
    half = std::max(half, std::hypot(gsl_cdf_tdist_Qinv(tail, freedom) * error,
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

double mean_velocity(Readings readings) {
  double sum = 0.0;
  for (const Reading& r : readings) sum += r.velocity;
  return sum / static_cast<double>(readings.size());
}

void add_means(const Group& group, std::vector<RestitutionMean>& means) {
  means.push_back(mean_of(group, group.readings));
  const bool repeated = group.readings.size() > group.settings.size();
  if (!repeated || group.settings.size() < 2) return;
  for (const Readings points : group.settings) {
    RestitutionMean of_setting = mean_of(group, points);
    of_setting.setting = points.front().setting;
    of_setting.velocity = mean_velocity(points);
    means.push_back(std::move(of_setting));
  }
}

RestitutionRange::End end_of(Readings readings) {
  RestitutionRange::End end{mean_velocity(readings)};
  double variance = 0.0;
  bool stated = true;
  for (const Reading& r : readings) {
    end.value += r.e;
    variance += std::pow(r.point->restitution_sd.value_or(0.0), 2);
    stated = stated && r.point->restitution_sd.has_value();
  }
  const auto n = static_cast<double>(readings.size());
  end.value /= n;
  end.error = stated ? std::sqrt(variance) / n : 0.0;
  return end;
}

std::vector<RestitutionRange> ranges_of(const std::vector<Group>& groups) {
  std::map<std::pair<std::size_t, std::size_t>, RestitutionRange> sizes;
  for (const Group& group : groups) {
    RestitutionRange& range = sizes[{group.dataset, group.size}];
    if (range.settings == 0) range.diameter = group.diameter;
    range.dataset = group.dataset;
    for (const Readings points : group.settings) {
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
  Line(Readings readings, std::size_t series, Eigen::Index degree = 1)
      : stated_(std::all_of(readings.begin(), readings.end(),
                            [](const Reading& r) { return r.sd > 0.0; })),
        launches_(count_launches(readings)) {
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
      const double log_v = std::log10(r.velocity);
      spread = std::max(spread, std::abs(log_v - middle[r.series] / count[r.series]));
      X(i, static_cast<Eigen::Index>(r.series)) = 1.0;
      for (Eigen::Index k = 1; k <= degree; ++k) {
        X(i, s + k - 1) = std::pow(log_v, static_cast<double>(k));
      }
      y(i) = r.e;
    }
    sloped_ = spread > 1e-9;
    if (!sloped_) X.conservativeResize(Eigen::NoChange, s);
    columns_ = X.cols();
    dof_ = static_cast<int>(n - columns_);
    solve(readings, X, y, 0.0);
    if (!solvable_) return;
    if (stated_ && dof_ > 0) {
      stated_scatter_ = {std::sqrt(square() / dof_), gsl_cdf_chisq_Q(square(), dof_)};
    }
    const bool shared = std::ranges::any_of(
        readings, [](const Reading& r) { return r.linked.launch != Observation::no_launch; });
    // An independent error beside those of shared instants.
    constexpr double largest = 1.0;
    const auto excess = [&](double error) {
      solve(readings, X, y, error);
      return square() - dof_;
    };
    if (stated_ && shared && dof_ > 0 && square() > dof_ && excess(largest) < 0.0) {
      excess(find_root(excess, 0.0, largest, 1e-9));
    } else if (shared) {
      solve(readings, X, y, 0.0);
    }
    variance_ = dof_ > 0 ? square() / dof_ : 0.0;
    const double unit = stated_ ? 1.0 : least_noise;
    scatters_ = dof_ > 0 && (stated_ || variance_ > unit * unit);
  }

  bool stated() const { return stated_; }
  bool sloped() const { return sloped_; }
  int dof() const { return dof_; }
  double square() const { return rest_.squaredNorm(); }
  double value(const Eigen::VectorXd& contrast) const { return contrast.dot(coefficients_); }
  Eigen::Index columns() const { return columns_; }
  const std::optional<LineScatter>& stated_scatter() const { return stated_scatter_; }
  /// Is an error known, stated or from the scatter?
  bool has_errors() const { return solvable_ && (stated_ || scatters_); }
  std::string missing() const {
    return dof_ < 1 ? "as many unknowns as readings, and no error is stated"
                    : "the readings do not scatter, and no error is stated";
  }

  /// The error of a contrast from the errors of the readings.
  double error(const Eigen::VectorXd& contrast) const {
    return std::sqrt(contrast.dot(inverse_ * contrast));
  }

  std::array<double, 2> interval(const Eigen::VectorXd& contrast) const {
    double half = stated_ ? gsl_cdf_ugaussian_Qinv(tail) * error(contrast) : 0.0;
    if (dof_ > 0) {
      half = std::max(half, gsl_cdf_tdist_Qinv(tail, scatter_dof()) * scatter_error(contrast));
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
    if (contrasts.cols() == 1 && clustered()) {
      const double of_scatter = scatter_error(contrasts.col(0));
      if (of_scatter > 0.0) {
        p = std::max(p, 2.0 * gsl_cdf_tdist_Q(std::abs(seen(0)) / of_scatter, scatter_dof()));
      }
    } else if (dof_ > 0 && variance_ > 0.0) {
      p = std::max(p, gsl_cdf_fdist_Q(square / count / variance_, count, dof_));
    }
    return p;
  }

 private:
  bool clustered() const { return launches_ >= fewest_launches; }
  double scatter_dof() const {
    return clustered() ? static_cast<double>(launches_) - 1.0 : static_cast<double>(dof_);
  }
  /// The error of a contrast from the scatter, between launches if there are enough.
  double scatter_error(const Eigen::VectorXd& contrast) const {
    if (!clustered()) return error(contrast) * std::sqrt(variance_);
    const Eigen::VectorXd side = inverse_ * contrast;
    double sum = 0.0;
    for (const Eigen::VectorXd& score : scores_) sum += std::pow(score.dot(side), 2);
    const auto count = static_cast<double>(launches_);
    return std::sqrt(sum * count / (count - 1.0));
  }

  /// Solves with the covariance of the readings: the stated one, and an independent `extra` error.
  void solve(Readings readings, Eigen::MatrixXd X, Eigen::VectorXd y, double extra) {
    std::map<std::size_t, std::vector<Eigen::Index>> runs;
    for (Eigen::Index i = 0; stated_ && i < y.size(); ++i) {
      const Reading& r = readings[static_cast<std::size_t>(i)];
      if (r.linked.launch != Observation::no_launch) {
        runs[r.linked.launch].push_back(i);
        continue;
      }
      const double weight = 1.0 / std::hypot(r.sd, extra);
      X.row(i) *= weight;
      y(i) *= weight;
    }
    for (const auto& [run, members] : runs) {
      const auto count = static_cast<Eigen::Index>(members.size());
      std::size_t last = 0;
      for (const Eigen::Index i : members) {
        last = std::max(last, readings[static_cast<std::size_t>(i)].linked.bounce);
      }
      Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(count, static_cast<Eigen::Index>(last) + 3);
      for (Eigen::Index k = 0; k < count; ++k) {
        const Reading& r = readings[static_cast<std::size_t>(members[static_cast<std::size_t>(k)])];
        const std::array<double, 3> part = instant_coefficients(r.e);
        for (std::size_t j = 0; j < part.size(); ++j) {
          loads(k, static_cast<Eigen::Index>(r.linked.bounce + j)) = r.sd * part[j];
        }
      }
      Eigen::MatrixXd covariance = loads * loads.transpose();
      covariance.diagonal().array() += extra * extra;
      const Eigen::LLT<Eigen::MatrixXd> root(covariance);
      const Eigen::MatrixXd rows = X(members, Eigen::all);
      const Eigen::VectorXd values = y(members);
      X(members, Eigen::all) = Eigen::MatrixXd(root.matrixL().solve(rows));
      y(members) = Eigen::VectorXd(root.matrixL().solve(values));
    }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(X);
    solvable_ = dof_ >= 0 && qr.rank() == X.cols();
    if (!solvable_) return;
    coefficients_ = qr.solve(y);
    inverse_ = (X.transpose() * X).inverse();
    rest_ = y - X * coefficients_;
    if (!clustered()) return;
    std::map<std::size_t, Eigen::VectorXd> scores;
    for (Eigen::Index i = 0; i < y.size(); ++i) {
      scores
          .try_emplace(readings[static_cast<std::size_t>(i)].launch,
                       Eigen::VectorXd::Zero(X.cols()))
          .first->second += rest_(i) * X.row(i).transpose();
    }
    scores_.clear();
    for (const auto& [launch, score] : scores) scores_.push_back(score);
  }

  bool stated_ = false, sloped_ = false, solvable_ = false, scatters_ = false;
  std::size_t launches_ = 0;
  Eigen::Index columns_ = 0;
  int dof_ = 0;
  double variance_ = 0.0;
  std::optional<LineScatter> stated_scatter_;
  Eigen::VectorXd coefficients_, rest_;
  Eigen::MatrixXd inverse_;
  std::vector<Eigen::VectorXd> scores_;  ///< sums of X' rest over launches
};

/// The mean reading of every setting.
std::vector<Reading> means_of_places(const std::vector<Readings>& settings) {
  std::vector<Reading> means;
  for (const Readings own : settings) {
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
bool places_scatter(const std::vector<Readings>& settings, const Line& line) {
  double within = 0.0, freedom = 0.0;
  for (const Readings readings : settings) {
    double sum = 0.0, first = 0.0, second = 0.0;  // of w, w e, w e^2
    for (const Reading& r : readings) {
      const double w = line.stated() ? 1.0 / (r.sd * r.sd) : 1.0;
      sum += w;
      first += w * r.e;
      second += w * r.e * r.e;
    }
    within += std::max(0.0, second - first * first / sum);
    freedom += static_cast<double>(readings.size()) - 1.0;
  }
  const double between = line.dof() - freedom;
  if (!(freedom >= 1.0) || !(between >= 1.0)) return false;
  const double square = std::max(0.0, line.square() - within) / between;
  double p = line.stated() ? gsl_cdf_chisq_Q(square * between, between) : 0.0;
  if (within > 0.0) p = std::max(p, gsl_cdf_fdist_Q(square / (within / freedom), between, freedom));
  return p < lack_of_fit_level;
}

/// The scatter of the points of settings about their means; nullopt without stated errors.
std::optional<LineScatter> scatter_within(const std::vector<Readings>& settings) {
  double square = 0.0, freedom = 0.0;
  for (const Readings readings : settings) {
    double w = 0.0, sum = 0.0;
    for (const Reading& r : readings) {
      if (!(r.sd > 0.0)) return std::nullopt;
      w += 1.0 / (r.sd * r.sd);
      sum += r.e / (r.sd * r.sd);
    }
    for (const Reading& r : readings) square += std::pow((r.e - sum / w) / r.sd, 2);
    freedom += static_cast<double>(readings.size()) - 1.0;
  }
  if (!(freedom > 0.0)) return std::nullopt;
  return LineScatter{std::sqrt(square / freedom), gsl_cdf_chisq_Q(square, freedom)};
}

/// The mean of a setting or launch.
struct BatchMean {
  Reading reading;  ///< `e`, `velocity`: means; `sd`: the error of this mean
  const Group* group = nullptr;
  int points = 0;
};

/// The means of batches of at least two readings each, with their errors.
std::vector<BatchMean> batch_means(const std::vector<Readings>& batches,
                                   const std::vector<Group>& groups) {
  double within = 0.0, freedom = 0.0;
  std::vector<BatchMean> means;
  std::vector<double> shared;
  for (const Readings readings : batches) {
    if (readings.size() < 2) continue;
    const auto n = static_cast<double>(readings.size());
    Reading sum = readings.front();
    sum.e = 0.0;
    sum.velocity = mean_velocity(readings);
    double of_setting = 0.0;
    for (const Reading& r : readings) {
      sum.e += r.e / n;
      of_setting += r.e * r.point->setting_velocity_sd.value_or(0.0) / r.velocity / n;
    }
    double square = 0.0;
    for (const Reading& r : readings) square += (r.e - sum.e) * (r.e - sum.e);
    within += square;
    freedom += n - 1.0;
    sum.sd = std::sqrt(variance_of_sum(readings)) / n;
    // Drops from a small height may scatter more than others, which only stated errors tell.
    if (!(sum.sd > 0.0)) sum.sd = std::sqrt(square / (n - 1.0) / n);
    means.push_back({sum, &groups[sum.series], static_cast<int>(readings.size())});
    shared.push_back(of_setting);
  }
  const double scatter = freedom > 0.0 ? std::sqrt(within / freedom) : 0.0;
  for (std::size_t k = 0; k < means.size(); ++k) {
    double& sd = means[k].reading.sd;
    sd = std::hypot(std::max(sd, scatter / std::sqrt(means[k].points)), shared[k]);
  }
  return means;
}

/// e = a + b V^q, for q = 0 with ln V, through means.
struct Curve {
  double square = 0.0;  ///< weighted sum of squares
  int dof = 0;
  double expected = 0.0, error = 0.0;  ///< of e at the mean that was left out
  double slope = 0.0;                  ///< d ln e / d ln V there
};

/// q of plastic contacts (-1/2: Wu, Li & Thornton 2003, Int. J. Impact Eng. 28, 929; -1/4: Johnson
/// 1985, Contact Mechanics, 11.5), of spheres with viscosity (1/5: Kuwabara & Kono 1987, Jpn. J.
/// Appl. Phys. 26, 1230), and of the damping of Hunt & Crossley (1: 1975, J. Appl. Mech. 42, 440).
constexpr std::array exponents = {-0.5, -0.25, 0.0, 0.2, 1.0};

/// @param skipped index; `none`: all means count
/// @param kink the velocity at which b changes [m/s]
Curve curve_through(std::span<const BatchMean> means, std::size_t skipped, double exponent,
                    std::optional<double> kink = std::nullopt) {
  const double middle = means[means.size() / 2].reading.velocity;
  const auto abscissa = [&](double velocity) {
    const double x = std::log(velocity / middle);
    return exponent == 0.0 ? x : std::expm1(exponent * x) / exponent;
  };
  const auto row_of = [&](double velocity) {
    Eigen::VectorXd row(kink ? 3 : 2);
    row(0) = 1.0;
    row(1) = abscissa(velocity);
    if (kink) row(2) = std::max(0.0, row(1) - abscissa(*kink));
    return row;
  };
  const auto n = static_cast<Eigen::Index>(means.size() - (skipped == none ? 0 : 1));
  Eigen::MatrixXd X(n, kink ? 3 : 2);
  Eigen::VectorXd y(n);
  Eigen::Index i = 0;
  for (std::size_t k = 0; k < means.size(); ++k) {
    if (k == skipped) continue;
    const Reading& mean = means[k].reading;
    X.row(i) = row_of(mean.velocity) / mean.sd;
    y(i++) = mean.e / mean.sd;
  }
  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver(X);
  const Eigen::MatrixXd inverse = solver.pseudoInverse();
  Curve curve;
  const Eigen::VectorXd coefficients = inverse * y;
  curve.square = (y - X * coefficients).squaredNorm();
  curve.dof = static_cast<int>(n - solver.rank());
  if (skipped == none) return curve;
  const double velocity = means[skipped].reading.velocity;
  const Eigen::VectorXd here = row_of(velocity);
  curve.expected = here.dot(coefficients);
  curve.error = (inverse.transpose() * here).norm();
  curve.slope = coefficients(1) * std::pow(velocity / middle, exponent) / curve.expected;
  return curve;
}

/// A mean beside the curves through all others.
struct Separation {
  double square = std::numeric_limits<double>::infinity();  ///< least sum of squares of the others
  double expected = 0.0, slope = 0.0;                       ///< by the curve with it
  double p_value = 1.0;                                     ///< largest of the curves that they fit
};

Separation separation_of(std::span<const BatchMean> means, std::size_t k, double tested) {
  const Reading& own = means[k].reading;
  Separation found;
  std::optional<double> largest;
  for (const double exponent : exponents) {
    const Curve curve = curve_through(means, k, exponent);
    if (curve.dof < 2) continue;
    if (curve.square < found.square) {
      found.square = curve.square;
      found.expected = curve.expected;
      found.slope = curve.slope;
    }
    if (gsl_cdf_chisq_Q(curve.square, curve.dof) < lack_of_fit_level) continue;
    const double apart = std::abs(own.e - curve.expected) / std::hypot(own.sd, curve.error);
    largest = std::max(largest.value_or(0.0), 2.0 * gsl_cdf_ugaussian_Q(apart) * tested);
  }
  found.p_value = std::min(1.0, largest.value_or(1.0));
  return found;
}

/// Least sum of squares of curves with a kink, at a mean or halfway to the next, through all.
double square_with_kink(std::span<const BatchMean> means) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k + 1 < means.size(); ++k) {
    const double here = means[k].reading.velocity;
    for (const double kink : {here, std::sqrt(here * means[k + 1].reading.velocity)}) {
      for (const double exponent : exponents) {
        least = std::min(least, curve_through(means, none, exponent, kink).square);
      }
    }
  }
  return least;
}

/// Is the velocity of a mean far from those of all others?
bool beyond_others(std::span<const BatchMean> means, std::size_t k) {
  constexpr double margin = 1.1;
  const double own = means[k].reading.velocity;
  const double lower = means[k == 0 ? 1 : 0].reading.velocity;
  const double upper = means[means.size() - (k + 1 == means.size() ? 2 : 1)].reading.velocity;
  return own * margin < lower || own > upper * margin;
}

/// The height in the name that `import` gives to a setting, "steel from 450 mm" [m]; nullopt unless
/// a fall from it, with some drag of air, can have this velocity.
std::optional<double> height_of(std::string_view setting, double velocity) {
  constexpr std::string_view before = " from ", after = " mm";
  // Shares of the energy that are left; gravity may differ by 2 % from the standard.
  constexpr double largest_share = 1.02, least_share = 0.25;
  const std::size_t start = setting.rfind(before);
  if (start == std::string_view::npos || !setting.ends_with(after)) return std::nullopt;
  setting.remove_suffix(after.size());
  const std::optional<double> number = parse_number(setting.substr(start + before.size()));
  if (!number) return std::nullopt;
  const double height = *number * units::mm;
  const double energy = 2.0 * standard_gravity * height;
  const bool fell =
      velocity * velocity < largest_share * energy && velocity * velocity > least_share * energy;
  return fell ? std::optional(height) : std::nullopt;
}

/// The mean that lies apart from the curve through all others of its series.
/// @param means of one series, by V
/// @param tested number of means of all series
std::optional<OutlyingBatch> outlying_in(std::span<const BatchMean> means, double tested,
                                         bool launch) {
  constexpr double level = 0.01;
  const double likelier = -2.0 * std::log(level);  // by the likelihood ratio
  std::vector<Separation> all;
  for (std::size_t k = 0; k < means.size(); ++k) all.push_back(separation_of(means, k, tested));
  const auto best = std::ranges::min_element(all, {}, &Separation::p_value);
  if (best == all.end() || best->p_value > level) return std::nullopt;
  const auto k = static_cast<std::size_t>(best - all.begin());
  if (beyond_others(means, k)) return std::nullopt;
  for (auto other = all.begin(); other != all.end(); ++other) {
    if (other != best && other->square < best->square + likelier) return std::nullopt;
  }
  if (!launch && square_with_kink(means) < best->square + likelier) return std::nullopt;
  const Reading& own = means[k].reading;
  OutlyingBatch found;
  found.dataset = means[k].group->dataset;
  found.series = means[k].group->series;
  found.launch = launch;
  found.name = launch ? own.point->launch : own.point->setting;
  found.points = means[k].points;
  found.velocity = own.velocity;
  found.value = best->expected;
  found.difference = own.e - best->expected;
  found.p_value = best->p_value;
  // V_rebound = e(V) V was measured, and V was computed from the stated height.
  constexpr double least_rise = 0.25;  // of ln V_rebound with ln V; less tells nothing of V
  const double rise = std::max(least_rise, 1.0 + best->slope);
  found.height_error = std::pow(own.e / best->expected, 2.0 / rise) - 1.0;
  if (!launch) found.height = height_of(found.name, own.velocity);
  if (found.height) {
    // d ln h / d ln V^2 = (exp x - 1) / x with x = 2 g h / V_t^2, by drag proportional to V^2.
    // It is 1 + x^2 / 12 times 2 g h / V^2 = x / (1 - exp(-x)), to the fourth order in x.
    found.height_error *= 2.0 * standard_gravity * *found.height / (own.velocity * own.velocity);
  }
  return found;
}

/// The mean of all series that lies apart from the others.
std::optional<OutlyingBatch> outlying(std::vector<BatchMean> means, bool launch) {
  constexpr std::size_t most = 200;  // every one costs curves through the others
  std::erase_if(means, [](const BatchMean& mean) { return !(mean.reading.sd > 0.0); });
  std::optional<OutlyingBatch> found;
  if (means.size() > most) return found;
  std::ranges::stable_sort(means, {}, [](const BatchMean& mean) {
    return std::pair(mean.reading.series, mean.reading.velocity);
  });
  const auto tested = static_cast<double>(means.size());
  for (auto first = means.begin(); first != means.end();) {
    const auto last = std::find_if(first, means.end(), [&](const BatchMean& mean) {
      return mean.reading.series != first->reading.series;
    });
    const std::span of_series(&*first, static_cast<std::size_t>(last - first));
    const std::optional<OutlyingBatch> own = outlying_in(of_series, tested, launch);
    if (own && (!found || own->p_value < found->p_value)) found = own;
    first = last;
  }
  return found;
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
  const std::optional<double> usual = usual_error(datasets);
  const std::vector<Group> groups = groups_of(datasets, usual);
  for (const Group& group : groups) {
    place_in_means.push_back(summary.means.size());
    for (const Readings points : group.settings) {
      for (const Reading& reading : points) {
        readings.push_back(reading);
        readings.back().series = place_in_means.size() - 1;
        readings.back().place = place;
        if (usual && !reading.point->restitution_sd) ++summary.without_error;
      }
      ++place;
    }
    add_means(group, summary.means);
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
  const std::vector<Readings> of_settings =
      runs_of(readings, [](const Reading& r) { return r.place; });
  std::vector<Reading> launched;
  std::ranges::copy_if(readings, std::back_inserter(launched),
                       [](const Reading& r) { return r.launch != none; });
  std::ranges::stable_sort(launched, {}, &Reading::launch);
  const std::vector<Readings> of_launches =
      runs_of(launched, [](const Reading& r) { return r.launch; });
  summary.outlier = outlying(batch_means(of_settings, groups), false);
  if (!summary.outlier) summary.outlier = outlying(batch_means(of_launches, groups), true);
  const bool scattered = of_launches.empty() && places_scatter(of_settings, Line(readings, series));
  const std::vector<Reading> used = scattered ? means_of_places(of_settings) : readings;
  const Line line(used, series);
  // An error that a setting shares is none of its repeats.
  const bool shared = std::ranges::any_of(
      readings, [](const Reading& r) { return r.point->setting_velocity_sd.value_or(0.0) > 0.0; });
  summary.scatter = shared      ? scatter_within(of_settings)
                    : scattered ? Line(readings, series).stated_scatter()
                                : line.stated_scatter();
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
