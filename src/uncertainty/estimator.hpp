#pragma once

/// The estimator as a library of its own, CMake target `recoil_estimator`: bounded nonlinear least
/// squares, and the intervals that follow from a fit and its bootstrap replicates. It needs only
/// residuals and derivatives and is independent of impacts.
///
///   recoil::LeastSquaresProblem problem;        // residuals, bounds, scales
///   recoil::LeastSquaresResult fit = recoil::minimise(problem, start);
///   recoil::Interval interval = recoil::wald_interval(fit.theta[0], error, 0.95, dof, -inf, inf);
#include "estimate/least_squares.hpp"
#include "uncertainty/intervals.hpp"
