#include "estimate/shared_errors.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "estimate/residual.hpp"

namespace recoil {
namespace {

/// The error of e of point i by one standard deviation of source k; 0 for a predicted capture.
double error_of_restitution(const Weights& weights, std::size_t k, std::size_t i) {
  const double m = weights.predicted[i];
  return m > 0.0 ? weights.effects[k][i] / (2.0 * std::sqrt(m)) : 0.0;
}

}  // namespace

bool has_own_scatter(const Observations& data, std::size_t point) {
  return std::none_of(data.sources.begin(), data.sources.end(), [&](const ErrorSource* source) {
    return source->is_scatter() && !source->parts(data.points[point]).empty();
  });
}

std::vector<std::vector<double>> loads_of_sources(const Observations& data,
                                                  const Weights& weights) {
  std::vector<std::vector<double>> loads(data.sources.size());
  if (weights.predicted.empty()) return loads;
  std::vector<double> slopes;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    const Observation& point = data.points[i];
    const double m = weights.predicted[i];
    slopes.push_back(
        point.censored ? 0.0 : std::abs(weighted_residual(point, weights.points[i], m).slope));
  }
  for (std::size_t k = 0; k < loads.size(); ++k) {
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      loads[k].push_back(slopes[i] * weights.effects[k][i]);
    }
  }
  return loads;
}

SharedErrors::SharedErrors(const Observations& data, const Weights& weights) {
  if (!data.share_errors()) return;
  // Every draw is a column of U; columns with a common point form one block.
  std::map<std::pair<std::size_t, std::uint64_t>, std::vector<Member>> columns;  // source, draw
  const std::vector<std::vector<double>> loads = loads_of_sources(data, weights);
  for (std::size_t k = 0; k < data.sources.size(); ++k) {
    const ErrorSource& source = *data.sources[k];
    if (source.shared == SharedBy::none || (!source.is_scatter() && loads[k].empty())) continue;
    for (std::size_t i = 0; i < data.points.size(); ++i) {
      const double load = source.is_scatter() ? 1.0 : loads[k][i];
      if (load == 0.0) continue;
      for (const ErrorPart& part : source.parts(data.points[i])) {
        columns[{k, part.draw}].push_back({i, load * part.factor});
      }
    }
  }
  std::map<std::size_t, std::size_t> block_of;  // block of a point
  std::vector<std::vector<const std::vector<Member>*>> blocks;
  for (const auto& [draw, members] : columns) {
    const std::size_t own = blocks.size();
    blocks.push_back({&members});
    for (const Member& member : members) {
      const std::size_t other = block_of.try_emplace(member.point, own).first->second;
      if (other == own) continue;
      for (const std::vector<Member>* column : blocks[other]) {
        for (const Member& moved : *column) block_of[moved.point] = own;
      }
      blocks[own].insert(blocks[own].end(), blocks[other].begin(), blocks[other].end());
      blocks[other].clear();
    }
  }
  for (const auto& own : blocks) {
    if (!own.empty()) add_block(data, own);
  }
}

void SharedErrors::add_block(const Observations& data,
                             const std::vector<const std::vector<Member>*>& columns) {
  Block block;
  std::map<std::size_t, Eigen::Index> row;
  for (const auto* column : columns) {
    for (const Member& member : *column) {
      if (row.try_emplace(member.point, static_cast<Eigen::Index>(row.size())).second) {
        block.points.push_back(member.point);
      }
    }
  }
  const auto errors = static_cast<Eigen::Index>(columns.size());
  Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(row.size()), errors);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    for (const Member& member : *columns[k]) {
      loads(row[member.point], static_cast<Eigen::Index>(k)) = member.load;
    }
  }
  Eigen::VectorXd own(loads.rows());
  for (Eigen::Index i = 0; i < own.size(); ++i) {
    own(i) = has_own_scatter(data, block.points[static_cast<std::size_t>(i)]) ? 1.0 : 0.0;
  }
  if (own.minCoeff() < 1.0) {
    Eigen::MatrixXd all = loads * loads.transpose();
    all.diagonal() += own;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> covariance(all);
    const Eigen::MatrixXd whole = covariance.operatorInverseSqrt();
    log_determinant_ += covariance.eigenvalues().array().log().sum();
    block.whole.assign(whole.data(), whole.data() + whole.size());
    blocks_.push_back(std::move(block));
    return;
  }
  // U'U = W S W' makes the root I - U W ((1 - (1 + S)^(-1/2)) / S) W' U'.
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> squares(loads.transpose() * loads);
  Eigen::VectorXd factors(errors);
  for (Eigen::Index k = 0; k < errors; ++k) {
    const double square = squares.eigenvalues()(k);
    factors(k) = square > 0.0 ? (1.0 - 1.0 / std::sqrt(1.0 + square)) / square : 0.5;
    log_determinant_ += std::log1p(std::max(0.0, square));
  }
  const Eigen::MatrixXd inner =
      squares.eigenvectors() * factors.asDiagonal() * squares.eigenvectors().transpose();
  block.loads.assign(loads.data(), loads.data() + loads.size());
  block.inner.assign(inner.data(), inner.data() + inner.size());
  blocks_.push_back(std::move(block));
}

void SharedErrors::whiten(std::span<double> rows, std::size_t columns) const {
  for (const Block& block : blocks_) {
    const auto count = static_cast<Eigen::Index>(block.points.size());
    Eigen::MatrixXd own(count, static_cast<Eigen::Index>(columns));
    for (Eigen::Index i = 0; i < count; ++i) {
      const double* row = &rows[block.points[static_cast<std::size_t>(i)] * columns];
      for (Eigen::Index k = 0; k < own.cols(); ++k) own(i, k) = row[k];
    }
    if (!block.whole.empty()) {
      own = Eigen::Map<const Eigen::MatrixXd>(block.whole.data(), count, count) * own;
    } else {
      const auto errors = static_cast<Eigen::Index>(block.loads.size()) / count;
      const Eigen::Map<const Eigen::MatrixXd> loads(block.loads.data(), count, errors);
      const Eigen::Map<const Eigen::MatrixXd> inner(block.inner.data(), errors, errors);
      own -= (loads * (inner * (loads.transpose() * own))).eval();
    }
    for (Eigen::Index i = 0; i < count; ++i) {
      double* row = &rows[block.points[static_cast<std::size_t>(i)] * columns];
      for (Eigen::Index k = 0; k < own.cols(); ++k) row[k] = own(i, k);
    }
  }
}

double ErrorDraws::draw(const ErrorSource& source, std::uint64_t number) {
  const auto [place, is_new] = drawn_.try_emplace({&source, number}, 0.0);
  if (is_new) place->second = random_.normal();
  return place->second;
}

double ErrorDraws::operator()(const ErrorSource& source, const Observation& point, std::size_t i) {
  if (source.shared == SharedBy::none) {
    return source.shift(point).relative() > 0.0 ? draw(source, i) : 0.0;
  }
  double sum = 0.0;
  for (const ErrorPart& part : source.parts(point)) sum += part.factor * draw(source, part.draw);
  return sum;
}

std::vector<double> draw_shared_errors(const Observations& data, const Weights& weights,
                                       double noise_scale, RandomStream& random) {
  std::vector<double> errors(data.points.size(), 0.0);
  ErrorDraws draws(random);
  for (std::size_t k = 0; k < data.sources.size(); ++k) {
    const ErrorSource& source = *data.sources[k];
    if (source.shared == SharedBy::none) continue;
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double of_e = source.is_scatter() ? noise_scale * weights.points[i].sd
                                              : error_of_restitution(weights, k, i);
      errors[i] += draws(source, data.points[i], i) * of_e;
    }
  }
  return errors;
}

double shifted_square(double restitution_squared, double error) {
  if (error == 0.0 || !(restitution_squared > 0.0)) return restitution_squared;
  const double e = std::max(0.0, std::sqrt(restitution_squared) + error);
  return e * e;
}

}  // namespace recoil
