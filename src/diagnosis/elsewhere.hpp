#pragma once

#include <Eigen/Dense>
#include <functional>
#include <vector>

#include "data/dataset.hpp"
#include "diagnosis/candidate.hpp"

namespace recoil {

/// A model of several datasets and of the same spheres on another target, on which there are no
/// impacts yet: what is known beforehand of its parameters.
struct Elsewhere {
  Candidate candidate;        ///< of the datasets, and of the target as the last one
  std::size_t dataset = 0;    ///< the place of the target
  std::vector<double> theta;  ///< [slots]
  std::vector<bool> moving;   ///< [slots]
  /// Of each parameter, in addition to what the datasets and the constants of the materials say:
  /// the inverse of its variance; 0: nothing is known [slots].
  Eigen::VectorXd precisions;
};

/// The model `here` at `theta` carried over to another target. On it nobody knows C_H and C_A,
/// which are taken for those of the present one with a standard deviation as large, nor the
/// adhesion (`log_sd_of_other_adhesion`), unless it follows from uncertain constants. The strength
/// of a mechanism is the same, or where the fit has one for each dataset, known like C_H.
/// @param target `on_target` of one of `datasets`, at place `like`
/// @param moving the parameters of `here` that are not known [slots]
Elsewhere carried_elsewhere(const FitSpec& spec, const std::vector<Dataset>& datasets,
                            const Dataset& target, std::size_t like, const Candidate& here,
                            const std::vector<double>& theta, const std::vector<bool>& moving);

/// The dataset with the most points: that whose spheres another target is for.
std::size_t fullest(const std::vector<Dataset>& datasets);

/// Where impacts on another target say most of what damps them there: of the smallest and the
/// largest spheres of `dataset` six velocities each, evenly spaced in ln V from where e of 0.3 is
/// `expected` up to `fastest`; none of a size for which that is less than a factor of three.
/// @param place of the target among the datasets
/// @param expected the least e that any model in question expects, for each place
std::vector<PointConditions> places_elsewhere(
    const Dataset& dataset, std::size_t place, double slowest, double fastest,
    const std::function<std::vector<double>(const std::vector<PointConditions>&)>& expected);

}  // namespace recoil
