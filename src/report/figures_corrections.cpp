#include <fmt/format.h>

#include <array>

#include "report/corrections.hpp"
#include "report/figure_style.hpp"
#include "report/format.hpp"
#include "report/svg_plot.hpp"

namespace recoil {
namespace {

constexpr std::array<style::Marker, 5> markers = {{{style::blue, 7},
                                                   {style::orange, 5},
                                                   {style::green, 9},
                                                   {style::purple, 13},
                                                   {style::grey, 6}}};
constexpr std::array<const char*, 5> names = {
    "all corrections", "at the plane", "second impacts in", "captures not counted", "none of them"};

PlotScript script_of(const std::string& name, const std::string& title, const std::string& remark) {
  PlotScript script;
  script.name = name;
  script.title = title;
  script.height = 390;
  script.commands = style::preamble() + style::title(title, remark);
  return script;
}

Figure error_figure(const CorrectionStudy& study, std::size_t index) {
  PlotScript script = script_of(fmt::format("corrections-e-{}", index),
                                "Mean restitution less the truth", study_words(study));
  const double lower = study.velocities.front() / 1.15;
  const double upper = study.velocities.back() * 1.15;
  std::string& c = script.commands;
  c += fmt::format("set logscale x\nset xrange [{:.6g}:{:.6g}]\n", lower, upper) +
       log_ticks('x', lower, upper) +
       "set xlabel 'incident velocity V  [m/s]' offset 0,0.4\n"
       "set ylabel 'e - truth' offset 1.2,0\n" +
       style::key_below(2);
  std::vector<std::string> layers = {
      fmt::format("0 with lines lc rgb '{}' lw 1 notitle", style::ink)};
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    // The mean of the rebounds is the same whether the captured are counted or not.
    if (study.rows[k].left_out == Correction::survivors) continue;
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < study.velocities.size(); ++i) {
      const auto& error = study.rows[k].error[i];
      if (error) rows.push_back({study.velocities[i], *error});
    }
    c += data_block(fmt::format("row{}", k), rows);
    layers.push_back(
        fmt::format("$row{} using 1:2 with linespoints lc rgb '{}' pt {} ps 0.5 lw 1.5 title {}", k,
                    markers[k].colour, markers[k].point, gnuplot_text(names[k])));
  }
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  const std::string caption = fmt::format(
      "{}. Mean over the rebounds of each velocity of e less the recipe's truth at the point's own "
      "diameter and velocity; zero is right. All lines rest on the same events, so what they "
      "differ "
      "by is no chance. Not counting captures leaves e as it is.",
      study_words(study));
  return {script.name, script.title, caption, draw_svg(script)};
}

Figure damping_figure(const CorrectionStudy& study, std::size_t index) {
  PlotScript script = script_of(fmt::format("corrections-damping-{}", index),
                                "The fitted damping of the adhesion", "");
  std::vector<double> values = {0.0, study.C_A};
  for (const CorrectionRow& row : study.rows) {
    if (row.usable) values.insert(values.end(), {row.C_A + row.C_A_sd, row.C_A - row.C_A_sd});
  }
  const style::Range range = style::range_of(values, 0.08);
  std::string& c = script.commands;
  c += fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{}:-1]\n", range.lower, range.upper,
                   study.rows.size());
  std::vector<std::string> ticks;
  std::vector<std::string> layers;
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    ticks.push_back(fmt::format("{} {}", gnuplot_text(names[k]), k));
  }
  c += fmt::format("set ytics ({})\nset lmargin 22\nunset key\n", fmt::join(ticks, ", ")) +
       style::few_ticks('x', range, 5) +
       "set xlabel 'C_{A}  [s/m]; vertical line: the truth' offset 0,0.4\n";
  c += data_block("truth",
                  {{study.C_A, -0.8}, {study.C_A, -0.2 + static_cast<double>(study.rows.size())}});
  layers.push_back(fmt::format("$truth using 1:2 with lines lc rgb '{}' lw 1.4", style::ink));
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    const CorrectionRow& row = study.rows[k];
    if (!row.usable) continue;
    c += data_block(fmt::format("row{}", k), {{row.C_A, static_cast<double>(k), row.C_A_sd}});
    layers.push_back(
        fmt::format("$row{0} using ($1-$3):2:(2*$3):(0) with vectors nohead lc rgb "
                    "'{1}' lw 2, $row{0} using 1:2 with points lc rgb '{1}' pt {2} ps "
                    "0.9",
                    k, markers[k].colour, markers[k].point));
  }
  c += fmt::format("plot {}\n", fmt::join(layers, ", \\\n  "));
  return {script.name, script.title,
          "C_A with one standard error (none where it rests on its bound), for the points of each "
          "way. The line is what the recipe put into the events.",
          draw_svg(script)};
}

}  // namespace

std::vector<Figure> correction_figures(const CorrectionStudy& study, std::size_t index) {
  return {error_figure(study, index), damping_figure(study, index)};
}

}  // namespace recoil
