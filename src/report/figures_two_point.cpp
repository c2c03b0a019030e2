#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/density.hpp"
#include "report/figure_style.hpp"
#include "report/figures.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_replicates = 600;  // drawn per cloud
constexpr double share_inside = 0.95;         // of the replicates within the line

using Rows = std::vector<std::vector<double>>;

/// (C_H, C_A) of every replicate, scaled for the axes.
Rows pairs(const Rows& theta, std::size_t slot_H, std::size_t slot_A, double scale_H,
           double scale_A) {
  Rows rows;
  for (const std::vector<double>& replicate : theta) {
    if (slot_H >= replicate.size() || slot_A >= replicate.size()) continue;
    rows.push_back({replicate[slot_H] * scale_H, replicate[slot_A] * scale_A});
  }
  return rows;
}

Rows thinned(const Rows& rows, style::Range x, style::Range y, std::size_t& outside) {
  Rows kept;
  const std::size_t stride = rows.size() / most_replicates + 1;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool inside = rows[i][0] >= x.lower && rows[i][0] <= x.upper && rows[i][1] >= y.lower &&
                        rows[i][1] <= y.upper;
    if (!inside) ++outside;
    if (inside && i % stride == 0) kept.push_back(rows[i]);
  }
  return kept;
}

/// An axis that holds the bulk of both clouds and both estimates, zero at the least.
style::Range common_range(const Rows& one, const Rows& other, std::size_t column, double a,
                          double b) {
  std::vector<double> shown = {a, b};
  for (const Rows* rows : {&one, &other}) {
    std::vector<double> values;
    for (const auto& row : *rows) values.push_back(row[column]);
    if (values.empty()) continue;
    const style::Range bulk = style::quantile_range(values, 0.01, 0.99);
    shown.push_back(bulk.lower);
    shown.push_back(bulk.upper);
  }
  style::Range range = style::range_of(shown, 0.06);
  range.lower = std::max(0.0, range.lower);
  return range;
}

/// Adds the line within which 95 % of the replicates lie, and returns its layer.
std::string outline(std::string& commands, const std::string& name, const Rows& rows,
                    style::Range x, style::Range y, const char* colour) {
  const std::vector<double> across = column(rows, 0, 1.0);
  const std::vector<double> up = column(rows, 1, 1.0);
  const std::string made =
      contour_commands(name, density(across, up, x, y), across, up, share_inside);
  if (made.empty()) return "";
  commands += made;
  return fmt::format(", \\\n  ${} using 1:2 with lines lc rgb '{}' lw 1.8 notitle", name, colour);
}

std::string status_words(const TwoPointComparison& comparison) {
  return comparison.result.status == TwoPointStatus::converged
             ? std::string()
             : fmt::format(" The two-point calibration itself ended without an answer: {}.",
                           words_of(to_string(comparison.result.status)));
}

Figure scatter(const Analysis& analysis, const TwoPointComparison& comparison) {
  const ImpactModel& model = analysis.fitted.model;
  const std::size_t H = model.slot_C_H[comparison.dataset];
  const std::size_t A = model.slot_C_A[comparison.dataset];
  const std::vector<double>& full = analysis.fitted.theta;
  const std::vector<double>& two = comparison.result.theta;
  const style::Scale scale_H = style::scale_for(std::abs(full[H]), model.slots[H].parameter->unit);
  const style::Scale scale_A = style::scale_for(std::abs(full[A]), model.slots[A].parameter->unit);
  const BootstrapResult& bootstrap = analysis.uncertainty.bootstrap;
  const Rows full_pairs = pairs(bootstrap.theta, H, A, scale_H.factor, scale_A.factor);
  const Rows two_pairs = comparison.dataset < bootstrap.two_point_theta.size()
                             ? pairs(bootstrap.two_point_theta[comparison.dataset], H, A,
                                     scale_H.factor, scale_A.factor)
                             : Rows();
  const bool converged =
      comparison.result.status == TwoPointStatus::converged && H < two.size() && A < two.size();
  const double full_H = full[H] * scale_H.factor;
  const double full_A = full[A] * scale_A.factor;
  const double two_H = converged ? two[H] * scale_H.factor : full_H;
  const double two_A = converged ? two[A] * scale_A.factor : full_A;
  const style::Range x = common_range(full_pairs, two_pairs, 0, full_H, two_H);
  const style::Range y = common_range(full_pairs, two_pairs, 1, full_A, two_A);
  std::size_t outside = 0;

  PlotScript script;
  script.name = fmt::format("two-point-{}", comparison.dataset + 1);
  script.title = fmt::format("Two points against all under resampling, {}",
                             analysis.datasets[comparison.dataset].id);
  script.height = 360;
  std::string& c = script.commands;
  c = style::preamble();
  const std::string two_line = outline(c, "around_two", two_pairs, x, y, style::vermillion);
  const std::string full_line = outline(c, "around_full", full_pairs, x, y, style::blue);
  c += fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\n", x.lower, x.upper,
                   y.lower, y.upper) +
       fmt::format(
           "set xlabel 'C_{{H}}  [{}]' offset 0,0.4\nset ylabel 'C_{{A}}  [{}]' offset 1,0\n",
           scale_H.unit, scale_A.unit) +
       "set bmargin 3.6\n" + style::key_above() +
       data_block("two", thinned(two_pairs, x, y, outside)) +
       data_block("full", thinned(full_pairs, x, y, outside)) +
       data_block("estimates", {{full_H, full_A}, {two_H, two_A}});
  c += fmt::format(
      "plot $two using 1:2 with points lc rgb '{0}' pt 7 ps 0.25 notitle, \\\n"
      "  $full using 1:2 with points lc rgb '{1}' pt 7 ps 0.25 notitle{2}{3}, \\\n"
      "  $estimates every ::0::0 using 1:2 with points lc rgb '{4}' pt 7 ps 1.1 title 'all "
      "points', \\\n",
      style::orange, style::sky, two_line, full_line, style::blue);
  c += converged ? fmt::format(
                       "  $estimates every ::1::1 using 1:2 with points lc rgb '{}' pt 9 "
                       "ps 1.3 title 'two points'\n",
                       style::vermillion)
                 : fmt::format("  NaN with lines lc rgb '{}' lw 1.8 title 'two points'\n",
                               style::vermillion);

  const std::size_t count = full_pairs.size() + two_pairs.size();
  std::string caption = analysis.datasets[comparison.dataset].id +
                        ". Small dots: each calibration repeated on resampled data; 95 % of them "
                        "lie within the line. "
                        "Large marks: the estimates.";
  if (count > 2 * most_replicates) {
    caption += fmt::format(" About {} replicates of each are drawn.", most_replicates);
  }
  if (outside > 0) caption += fmt::format(" {} lie outside the picture.", outside);
  if (comparison.failed > 0) {
    caption += fmt::format(" In {} replicates the two-point iteration found no answer.",
                           comparison.failed);
  }
  caption += status_words(comparison);
  return {script.name, script.title, caption, draw_svg(script)};
}

}  // namespace

std::vector<Figure> two_point_figures(const Analysis& analysis) {
  std::vector<Figure> figures;
  for (const TwoPointComparison& comparison : analysis.uncertainty.two_point) {
    figures.push_back(scatter(analysis, comparison));
  }
  return figures;
}

}  // namespace recoil
