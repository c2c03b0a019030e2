#include "diagnosis/structure.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "core/random.hpp"
#include "diagnosis/discrepancy.hpp"
#include "estimate/residual.hpp"
#include "estimate/shared_errors.hpp"

namespace recoil {
namespace {

constexpr int highest_degree = 11;  // highest degree of the free form in ln V
// Smallest part of a function, orthogonal to the model, that is tested.
constexpr double negligible = 1e-6;
constexpr double rounding_of_statistic = 1e-9;  // relative; a smaller difference is none
constexpr double same_diameter = 0.005;  // relative difference of diameters that count as equal

double dot(std::span<const double> a, std::span<const double> b) {
  const auto vector = [](std::span<const double> values) {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  return vector(a).dot(vector(b));
}

/// P_0 .. P_degree at u in [-1, 1] (Bonnet's recursion).
std::vector<double> legendre(double u, int degree) {
  std::vector<double> p = {1.0, u};
  for (int k = 1; k < degree; ++k) {
    p.push_back(((2 * k + 1) * u * p[static_cast<std::size_t>(k)] -
                 k * p[static_cast<std::size_t>(k) - 1]) /
                (k + 1));
  }
  p.resize(static_cast<std::size_t>(degree) + 1);
  return p;
}

/// `values` mapped onto [-1, 1]; zeros if all are equal.
std::vector<double> onto_unit(const std::vector<double>& values) {
  const auto [low, high] = std::ranges::minmax_element(values);
  std::vector<double> unit(values.size(), 0.0);
  if (!(*high > *low)) return unit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    unit[i] = 2.0 * (values[i] - *low) / (*high - *low) - 1.0;
  }
  return unit;
}

/// The fraction of `sorted` that is at least `value`, up to rounding, counting the data themselves.
double upper_share(const std::vector<double>& sorted, double value) {
  const double least = value - rounding_of_statistic * std::max(1.0, std::abs(value));
  const auto below = std::lower_bound(sorted.begin(), sorted.end(), least) - sorted.begin();
  const auto n = static_cast<double>(sorted.size());
  return (1.0 + n - static_cast<double>(below)) / (n + 1.0);
}

/// The samples, with 0 for points that are not used [samples x points].
Eigen::MatrixXd matrix_of(const Samples& samples, const std::vector<bool>& used) {
  Eigen::MatrixXd all(static_cast<Eigen::Index>(samples.size()),
                      static_cast<Eigen::Index>(used.size()));
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (std::size_t b = 0; b < samples.size(); ++b) {
      all(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(i)) =
          used[i] ? samples[b][i] : 0.0;
    }
  }
  return all;
}

/// The projection of every sample onto each column [samples x columns].
Eigen::MatrixXd parts_along(const Eigen::MatrixXd& samples,
                            const std::vector<std::vector<double>>& columns) {
  Eigen::MatrixXd all(samples.cols(), static_cast<Eigen::Index>(columns.size()));
  for (Eigen::Index k = 0; k < all.cols(); ++k) {
    all.col(k) = Eigen::Map<const Eigen::VectorXd>(columns[static_cast<std::size_t>(k)].data(),
                                                   samples.cols());
  }
  return samples * all;
}

}  // namespace

StructureStatistics::StructureStatistics(const Observations& data, const Weights& weights,
                                         const Refit& fitted, std::span<const double> predicted,
                                         const std::vector<std::vector<double>>& shapes)
    : stated_(data.noise.sd_stated),
      noise_known_(weights.noise.known),
      slopes_(data.points.size()),
      shared_(data, weights),
      discrepancy_(fitted.discrepancy),
      used_(data.points.size(), true) {
  const std::size_t n = data.points.size();
  const std::size_t p = fitted.theta.size();
  for (std::size_t i = 0; i < n; ++i) {
    used_[i] = data.points[i].informs(predicted[i]);
    slopes_[i] =
        weighted_residual(data.points[i], weights.points[i], predicted[i], data.noise.student)
            .slope;
  }
  std::map<std::tuple<std::size_t, std::size_t, double, double>, std::size_t> impacts;
  for (const Observation& point : data.points) {
    const std::size_t next = impacts.size();
    impact_.push_back(
        impacts.try_emplace({point.dataset, point.series, point.diameter, point.velocity}, next)
            .first->second);
  }
  used_count_ = static_cast<std::size_t>(std::ranges::count(used_, true));
  for (std::size_t j = 0; j < p; ++j) {
    if (!fitted.moving[j]) continue;
    Column column(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      if (used_[i]) column[i] = fitted.jacobian[i * p + j];
    }
    if (orthogonalise(column, {})) model_.push_back(std::move(column));
  }
  add_local_functions(data);
  add_global_functions(data);
  for (const std::vector<double>& shape : shapes) {
    std::vector<Column> own;
    take(shape, own);
    if (!own.empty()) causes_.push_back(std::move(own.front()));
  }
}

bool StructureStatistics::orthogonalise(Column& column, const std::vector<Column>& against) const {
  const double before = std::sqrt(dot(column, column));
  if (!(before > 0.0)) return false;
  for (int pass = 0; pass < 2; ++pass) {  // twice is enough (Giraud, Langou & Rozloznik 2005)
    for (const std::vector<Column>* columns : {&model_, &against}) {
      for (const Column& other : *columns) {
        const double along = dot(column, other);
        for (std::size_t i = 0; i < column.size(); ++i) column[i] -= along * other[i];
      }
    }
  }
  const double after = std::sqrt(dot(column, column));
  if (!(after > std::sqrt(negligible) * before)) return false;
  for (double& value : column) value /= after;
  return true;
}

/// Projects a function onto slopes times one number for each kind of impact, which is the exact
/// form of every function. The slopes in the Jacobian and in the whitening differ from these by
/// rounding errors, which grow tenfold with each power of ln V until they follow the individual
/// readings; the projection removes them.
void StructureStatistics::keep_to_impacts(Column& column) const {
  std::vector<double> along(impact_.size(), 0.0), square(impact_.size(), 0.0);
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!used_[i]) continue;
    along[impact_[i]] += slopes_[i] * column[i];
    square[impact_[i]] += slopes_[i] * slopes_[i];
  }
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (used_[i]) column[i] = slopes_[i] * along[impact_[i]] / square[impact_[i]];
  }
  const double length = std::sqrt(dot(column, column));
  for (double& value : column) value /= length;
}

/// Weights and whitens `column`, a discrepancy of e^2, and appends its part orthogonal to the model
/// and to `into`, if anything is left.
void StructureStatistics::take(Column column, std::vector<Column>& into) const {
  for (std::size_t i = 0; i < column.size(); ++i) column[i] *= slopes_[i];
  shared_.whiten(column);
  discrepancy_->whiten(column);
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (!used_[i]) column[i] = 0.0;
  }
  if (!orthogonalise(column, into)) return;
  keep_to_impacts(column);
  into.push_back(std::move(column));
}

void StructureStatistics::add_local_functions(const Observations& data) {
  const std::size_t n = data.points.size();
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < n; ++i) {
    if (used_[i]) order.push_back(i);
  }
  std::ranges::stable_sort(order, {}, [&](std::size_t i) {
    return std::pair(data.points[i].dataset, data.points[i].diameter);
  });
  std::vector<std::vector<std::size_t>> groups;
  for (const std::size_t i : order) {
    const Observation& point = data.points[i];
    const bool fresh =
        groups.empty() || data.points[groups.back().front()].dataset != point.dataset ||
        point.diameter > data.points[groups.back().front()].diameter * (1.0 + same_diameter);
    if (fresh) groups.emplace_back();
    groups.back().push_back(i);
  }
  Column near_capture(n, 0.0);
  for (std::vector<std::size_t>& run : groups) {
    std::ranges::stable_sort(run, {}, [&](std::size_t i) { return data.points[i].velocity; });
    std::vector<std::vector<std::size_t>>& velocities = runs_.emplace_back();
    for (std::size_t k = 0; k < run.size(); ++k) {
      const bool same = k > 0 && data.points[run[k]].velocity == data.points[run[k - 1]].velocity;
      if (!same) velocities.emplace_back();
      velocities.back().push_back(run[k]);
    }
    std::vector<double> log_velocity;
    for (const std::size_t i : run) log_velocity.push_back(std::log(data.points[i].velocity));
    const std::vector<double> unit = onto_unit(log_velocity);
    // The functions of a family are orthogonal to each other (groups have no common points and are
    // coupled only through the model).
    const std::array families = {&size_, &trend_, &curvature_};
    for (std::size_t degree = 0; degree < std::min(families.size(), run.size()); ++degree) {
      Column column(n, 0.0);
      for (std::size_t k = 0; k < run.size(); ++k) column[run[k]] = legendre(unit[k], 2)[degree];
      take(std::move(column), *families[degree]);
    }
    for (std::size_t k = 0; k < run.size(); ++k) {
      near_capture[run[k]] = std::exp(2.0 * (log_velocity.front() - log_velocity[k]));
    }
  }
  take(std::move(near_capture), capture_);
}

void StructureStatistics::add_global_functions(const Observations& data) {
  const std::size_t n = data.points.size();
  std::vector<double> log_velocity, log_diameter;
  for (const Observation& point : data.points) {
    log_velocity.push_back(std::log(point.velocity));
    log_diameter.push_back(std::log(point.diameter));
  }
  const std::vector<double> u = onto_unit(log_velocity);
  const std::vector<double> w = onto_unit(log_diameter);
  const int degrees = std::min<int>(highest_degree, static_cast<int>(longest_run()) - 2);
  for (int degree = 0; degree <= degrees; ++degree) {
    for (const bool with_size : {false, true}) {
      if (smooth_.size() + model_.size() + 3 > used_count_) return;
      Column column(n, 0.0);
      for (std::size_t i = 0; i < n; ++i) {
        if (!used_[i]) continue;
        column[i] = legendre(u[i], std::max(degree, 1))[static_cast<std::size_t>(degree)] *
                    (with_size ? w[i] : 1.0);
      }
      take(std::move(column), smooth_);
    }
  }
}

std::size_t StructureStatistics::longest_run() const {
  std::size_t longest = 0;
  for (const auto& run : runs_) longest = std::max(longest, run.size());
  return longest;
}

bool StructureStatistics::asks(StructureQuestion question) const {
  if (!noise_known_ || used_count_ <= model_.size()) return false;
  switch (question) {
    case StructureQuestion::scatter:
      return stated_;
    case StructureQuestion::size:
      return !size_.empty();
    case StructureQuestion::trend:
      return !trend_.empty();
    case StructureQuestion::curvature:
      return !curvature_.empty();
    case StructureQuestion::capture:
      return !capture_.empty();
    case StructureQuestion::runs: {
      std::size_t places = 0;
      for (const auto& run : runs_) places += run.size();
      return places > model_.size() && longest_run() > 1;
    }
    case StructureQuestion::smooth:
      return !smooth_.empty();
    case StructureQuestion::cause:
      return !causes_.empty();
  }
  return false;
}

PerValue<StructureQuestion, double> StructureStatistics::operator()(
    std::span<const double> residuals) const {
  return (*this)(Samples{{residuals.begin(), residuals.end()}}).front();
}

std::vector<PerValue<StructureQuestion, double>> StructureStatistics::operator()(
    const Samples& residuals) const {
  Eigen::MatrixXd r = matrix_of(residuals, used_);
  const Eigen::ArrayXd square = r.rowwise().squaredNorm();
  if (!stated_) {  // in units of their root mean square
    const double dof = static_cast<double>(used_count_) - static_cast<double>(model_.size());
    const Eigen::ArrayXd scale = (square / std::max(dof, 1.0)).sqrt();
    for (Eigen::Index b = 0; b < r.rows(); ++b) {
      if (scale(b) > 0.0) r.row(b) /= scale(b);
    }
  }
  Eigen::ArrayXd runs = Eigen::ArrayXd::Zero(r.rows());
  for (const auto& run : runs_) {
    Eigen::ArrayXd before = Eigen::ArrayXd::Zero(r.rows());
    for (const std::vector<std::size_t>& members : run) {
      Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(r.rows());
      double square_of_slopes = 0.0;
      for (const std::size_t i : members) {
        mean += slopes_[i] * r.col(static_cast<Eigen::Index>(i)).array();
        square_of_slopes += slopes_[i] * slopes_[i];
      }
      mean *= square_of_slopes > 0.0 ? 1.0 / std::sqrt(square_of_slopes) : 0.0;
      runs += before * mean;
      before = std::move(mean);
    }
  }
  const Eigen::MatrixXd of_smooth = parts_along(r, smooth_);
  const double nothing = smooth_.empty() ? 0.0 : -INFINITY;
  Eigen::ArrayXd smooth = Eigen::ArrayXd::Constant(r.rows(), nothing);
  Eigen::ArrayXd along = Eigen::ArrayXd::Zero(r.rows());
  for (Eigen::Index m = 0; m < of_smooth.cols(); ++m) {
    along += of_smooth.col(m).array().square();
    const auto count = static_cast<double>(m + 1);
    smooth = smooth.max((along - count) / std::sqrt(2.0 * count));
  }
  std::vector<PerValue<StructureQuestion, double>> answers(static_cast<std::size_t>(r.rows()));
  const auto take = [&](StructureQuestion question, const Eigen::ArrayXd& values) {
    for (std::size_t b = 0; b < answers.size(); ++b) {
      answers[b][question] = values(static_cast<Eigen::Index>(b));
    }
  };
  const auto squares_along = [&](const std::vector<Column>& columns) {
    return Eigen::ArrayXd(parts_along(r, columns).rowwise().squaredNorm());
  };
  take(StructureQuestion::scatter, stated_ ? square : Eigen::ArrayXd(0.0 * square));
  take(StructureQuestion::size, squares_along(size_));
  take(StructureQuestion::trend, squares_along(trend_));
  take(StructureQuestion::curvature, squares_along(curvature_));
  take(StructureQuestion::capture, squares_along(capture_));
  take(StructureQuestion::runs, runs);
  take(StructureQuestion::smooth, smooth);
  Eigen::ArrayXd cause = Eigen::ArrayXd::Zero(r.rows());
  if (!causes_.empty()) {
    const Eigen::ArrayXXd exponents = 0.25 * parts_along(r, causes_).array().square();
    const Eigen::ArrayXd most = exponents.rowwise().maxCoeff();
    cause = most + (exponents.colwise() - most).exp().rowwise().mean().log();
  }
  take(StructureQuestion::cause, cause);
  return answers;
}

Samples StructureStatistics::residuals_of_noise(const Samples& noise) const {
  const Eigen::MatrixXd along = parts_along(matrix_of(noise, used_), model_);
  Samples left = noise;
  for (std::size_t b = 0; b < left.size(); ++b) {
    for (std::size_t i = 0; i < used_.size(); ++i) {
      double& value = left[b][i];
      if (!used_[i]) value = 0.0;
      for (std::size_t k = 0; k < model_.size(); ++k) {
        value -= along(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(k)) * model_[k][i];
      }
    }
  }
  return left;
}

std::vector<double> StructureStatistics::free_form(std::span<const double> residuals) const {
  double best = 0.0, along = 0.0;
  std::size_t order = 0;
  for (std::size_t m = 0; m < smooth_.size(); ++m) {
    along += std::pow(dot(smooth_[m], residuals), 2);
    const double gain = along - 2.0 * static_cast<double>(m + 1);
    if (gain > best) {
      best = gain;
      order = m + 1;
    }
  }
  if (order == 0) return {};
  std::vector<double> shape(residuals.size(), 0.0);
  for (std::size_t m = 0; m < order; ++m) {
    const double size = dot(smooth_[m], residuals);
    for (std::size_t i = 0; i < shape.size(); ++i) shape[i] += size * smooth_[m][i];
  }
  return shape;
}

Structure judge_structure(const StructureStatistics& statistics, std::span<const double> observed,
                          const std::vector<PerValue<StructureQuestion, double>>& simulated) {
  Structure judged;
  judged.simulated = static_cast<int>(simulated.size());
  const PerValue<StructureQuestion, double> own = statistics(observed);
  std::vector<double> smallest(simulated.size(), 1.0);
  double smallest_own = 1.0;
  const auto asked = std::ranges::count_if(
      values_of<StructureQuestion>(), [&](StructureQuestion one) { return statistics.asks(one); });
  for (const StructureQuestion question : values_of<StructureQuestion>()) {
    if (!statistics.asks(question)) continue;
    std::vector<double> sorted;
    for (const auto& sample : simulated) sorted.push_back(sample[question]);
    std::ranges::sort(sorted);
    const double p = upper_share(sorted, own[question]);
    judged.tests.push_back({question, own[question], p});
    const bool half = question == StructureQuestion::cause && asked > 1;
    const double share = half ? static_cast<double>(asked - 1) : 1.0;  // of the level
    smallest_own = std::min(smallest_own, p / share);
    for (std::size_t b = 0; b < simulated.size(); ++b) {
      smallest[b] = std::min(smallest[b], upper_share(sorted, simulated[b][question]) / share);
    }
    if (question != StructureQuestion::scatter && p <= 0.01) judged.smooth = true;
  }
  const auto as_small =
      std::ranges::count_if(smallest, [&](double p) { return p <= smallest_own; });
  judged.p_value =
      (1.0 + static_cast<double>(as_small)) / (1.0 + static_cast<double>(simulated.size()));
  return judged;
}

Samples white_noise(int samples, std::size_t points, std::uint64_t seed) {
  Samples noise;
  for (int b = 0; b < samples; ++b) {
    RandomStream random(seed, RandomPurpose::diagnosis, static_cast<std::uint64_t>(b));
    noise.emplace_back(points);
    for (double& value : noise.back()) value = random.normal();
  }
  return noise;
}

Structure quick_structure(const Observations& data, const Weights& weights, const Refit& fitted,
                          std::span<const double> predicted, const Samples& noise) {
  const StructureStatistics statistics(data, weights, fitted, predicted);
  return judge_structure(statistics, fitted.residuals,
                         statistics(statistics.residuals_of_noise(noise)));
}

}  // namespace recoil
