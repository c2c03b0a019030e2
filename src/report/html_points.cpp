#include <fmt/format.h>

#include <algorithm>

#include "report/format.hpp"
#include "report/html_page.hpp"
#include "report/html_tables.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_points = 1000;  // in the table, so that the page stays under 1 MB

}  // namespace

std::string points_table(const Analysis& a) {
  const FitResult& f = a.fitted;
  HtmlTable table;
  table.compact = true;
  const bool joint = a.datasets.size() > 1;
  table.head = {"series", "d [µm]", "<i>V</i> [m/s]", "<i>e</i>",
                "sd",     "fit",    "residual [sd]",  "leverage"};
  if (joint) table.head.insert(table.head.begin(), "dataset");
  const double unit = residual_unit(a);
  const std::size_t count = std::min(a.fitted.data.points.size(), most_points);
  for (std::size_t i = 0; i < count; ++i) {
    const Observation& point = a.fitted.data.points[i];
    const Dataset& dataset = a.datasets[point.dataset];
    const std::string series =
        point.series < dataset.series.size() ? dataset.series[point.series] : "";
    table.rows.push_back(
        {escape_html(series), diameter_text(point.diameter), number(point.velocity),
         point.censored ? "captured" : fmt::format("{:.4f}", point.restitution),
         a.fitted.data.sd_stated ? number(point.weights.sd, 2) : "–",
         i < f.prediction.size() ? fmt::format("{:.4f}", f.prediction[i]) : "–",
         i < f.residuals.size() ? fmt::format("{:+.2f}", f.residuals[i] / unit) : "–",
         i < f.leverage.size() ? fmt::format("{:.3f}", f.leverage[i]) : "–"});
    if (joint) table.rows.back().insert(table.rows.back().begin(), escape_html(dataset.id));
  }
  std::string out = table_html(table);
  if (count < a.fitted.data.points.size()) {
    out += fmt::format("<p>The first {} of {} points; fit.json has them all.</p>\n", count,
                       a.fitted.data.points.size());
  }
  return out;
}

}  // namespace recoil
