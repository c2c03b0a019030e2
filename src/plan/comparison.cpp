#include "plan/comparison.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/odds.hpp"

namespace recoil {
namespace {

constexpr double unknown_precision = 1e-10;  // of a free parameter, in the points' own
constexpr int rounds_of_amplitude = 3;

}  // namespace

Comparison::Comparison(const PlanGround& ground, double law_error, const Effect& truth,
                       const Effect* rival, double least, double most)
    : ground_(ground), law_error_(law_error), truth_(truth), rival_(rival) {
  if (rival != nullptr) k_ = std::clamp(amplitude(ground, truth, *rival), least, most);
  lay_out();
  for (int round = 0; rival != nullptr && round < rounds_of_amplitude; ++round) {
    const Eigen::VectorXd z = rival->change.head(ground.settings);
    const double zz = product(z, z);
    if (!(zz > 0.0)) break;
    const double next =
        std::clamp(product(truth_.change.head(ground.settings), z) / zz, least, most);
    if (std::abs(next - k_) < 1e-3 * std::abs(next)) break;
    k_ = next;
    lay_out();
  }
  const Eigen::VectorXd y = left();
  chi2_ = std::max(0.0, product(y, y));
  found_ = factor_.solve(columns_.topRows(ground.settings).transpose() * y);
}

std::optional<int> Comparison::impacts_for(Eigen::Index i, bool no_truth, bool no_rival) const {
  Eigen::VectorXd row = columns_.row(i).transpose();
  double y = 0.0;
  if (!no_truth) y += truth_.change(i);
  if (!no_rival && rival_ != nullptr) y -= k_ * rival_->change(i);
  if (no_truth) row.segment(of_truth_, functions()).setZero();
  if (no_rival && rival_ != nullptr) row.tail(row.size() - of_rival_).setZero();
  row *= ground_.once(i);
  const double apart = ground_.once(i) * y - row.dot(found_);
  const double spread = row.dot(factor_.solve(row));
  const double lacking = 2.0 * wanted_log_odds - chi2_;
  const double room = apart * apart / lacking - spread;  // for 1 / n
  if (!(room * most_more_impacts > 1.0)) return std::nullopt;
  return std::max(1, static_cast<int>(std::ceil(1.0 / room)));
}

/// Everything that could make up for the effect: parameters, errors of the laws.
void Comparison::lay_out() {
  const Eigen::Index p = ground_.slopes.cols();
  const Eigen::Index r = functions();
  const Eigen::Index released = rival_ != nullptr ? rival_->released.cols() : 0;
  of_truth_ = p + r;
  of_rival_ = p + 2 * r;
  columns_.resize(ground_.slopes.rows(), of_rival_ + (rival_ != nullptr ? r + released : 0));
  columns_.leftCols(p) = ground_.slopes;
  columns_.middleCols(p, r) = ground_.errors;
  columns_.middleCols(of_truth_, r) = (law_error_ * truth_.change).asDiagonal() * ground_.functions;
  if (rival_ != nullptr) {
    columns_.middleCols(of_rival_, r) =
        (law_error_ * k_ * rival_->change).asDiagonal() * ground_.functions;
    columns_.rightCols(released) = k_ * rival_->released;
  }
  const auto made = columns_.topRows(ground_.settings);
  Eigen::MatrixXd information = made.transpose() * made;
  for (Eigen::Index j = 0; j < information.rows(); ++j) {
    const double prior = j >= p ? 1.0 : ground_.known(j);
    information(j, j) += prior > 0.0 ? prior : unknown_precision * information(j, j) + 1e-300;
  }
  factor_.compute(information);
}

/// What the rival leaves of the effect before anything else makes up for it.
Eigen::VectorXd Comparison::left() const {
  Eigen::VectorXd y = truth_.change.head(ground_.settings);
  if (rival_ != nullptr) y -= k_ * rival_->change.head(ground_.settings);
  return y;
}

/// a' S^-1 b, S the covariance of the settings with all of `columns_`.
double Comparison::product(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  const auto made = columns_.topRows(ground_.settings);
  return a.dot(b) - (made.transpose() * a).dot(factor_.solve(made.transpose() * b));
}

std::optional<Comparison> closest_comparison(const PlanGround& ground, double law_error,
                                             const PossibleCause& truth,
                                             const PossibleCause& rival) {
  std::optional<Comparison> closest;
  const auto compare = [&](const Effect& effect) {
    const double scale = amplitude(ground, effect, rival.typical);
    if (!(std::abs(scale) > 0.0)) return;
    const double least = std::min(rival.least / scale, rival.most / scale);
    const double most = std::max(rival.least / scale, rival.most / scale);
    Comparison with(ground, law_error, truth.typical, &effect, least, most);
    if (!closest || with.log_odds() < closest->log_odds()) closest.emplace(std::move(with));
  };
  compare(rival.typical);
  for (const Effect& other : rival.others) compare(other);
  return closest;
}

}  // namespace recoil
