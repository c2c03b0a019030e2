#pragma once

#include <string>
#include <vector>

#include "analysis/analysis.hpp"
#include "document/document.hpp"
#include "report/panels.hpp"

/// A fit of the paper's data, and its pictures and numbers on the page of the paper.
namespace recoil::paper {

struct Fit {
  std::string key;   ///< in the ids of statements
  std::string file;  ///< of `fits`, without its extension
  Analysis a = {};

  const TwoPointComparison& two_point() const { return a.uncertainty.two_point.at(0); }
  const Dataset& data() const { return a.datasets.at(0); }
};

/// A figure with one plot.
Figure figure(const std::string& name, const std::string& title, plot::Plot plot,
              const Sentence& caption, int height = 340);

/// Counts in bins by Sturges' rule, as in the paper. @param unit_size SI value of the axis' unit
plot::Plot histogram_plot(const std::vector<double>& values, const std::string& label,
                          const std::string& unit_name, double unit_size);

/// Empty axes of e against V.
plot::Plot restitution_plot(plot::Range velocity);

/// The points of a diameter [m]; of all diameters if it is 0.
plot::Points points_of(const Fit& fit, double diameter, plot::Marker marker,
                       const std::string& name);

/// e(V) of every size of a fit by all points and by two points, with the points.
Figure calibrations_figure(const Fit& fit, const std::string& name, plot::Range velocity);

/// C_H, C_A, f0 and the rms of e by two points and by all points.
Table calibration_table(const Fit& fit);

/// V* at the reference diameter, with its interval [m/s]: "1.01 [0.998, 1.03]".
Sentence capture_words(const Fit& fit);

/// The parameter of the first slot, by all points, with its standard error.
Number estimate_of(const Fit& fit, const std::vector<std::size_t>& slots);

}  // namespace recoil::paper
