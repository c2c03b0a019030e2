#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "report/figure_style.hpp"
#include "report/svg_plot.hpp"
#include "studies/hidden_effects_study.hpp"

namespace hidden {
namespace {

struct Curve {
  const char* label;
  std::vector<Mark> marks;
  bool without;  ///< all but these
};

const std::vector<Curve>& curves() {
  static const std::vector<Curve> all = {
      {"misfit seen", {Mark::nothing, Mark::failed}, true},
      {"named or listed", {Mark::named, Mark::inside}, false},
      {"named outright", {Mark::named}, false},
      {"wrong cause named", {Mark::wrong}, false},
  };
  return all;
}

std::string power_panel(const std::vector<Answered>& answers) {
  std::string commands;
  std::string plots;
  for (std::size_t k = 0; k < curves().size(); ++k) {
    const Curve& curve = curves()[k];
    std::vector<std::vector<double>> rows;
    for (const double strength : study_strengths()) {
      double n = 0.0;
      double hits = 0.0;
      for (const Answered& a : answers) {
        if (!a.reached || arm_of(a.order) != Arm::effect || a.order.signal_to_noise != strength) {
          continue;
        }
        const bool in =
            std::find(curve.marks.begin(), curve.marks.end(), mark_of(a)) != curve.marks.end();
        n += 1.0;
        hits += in != curve.without ? 1.0 : 0.0;
      }
      const double none = std::numeric_limits<double>::quiet_NaN();
      rows.push_back({strength, n > 0.0 ? 100.0 * hits / n : none});
    }
    const std::string name = fmt::format("power{}", k);
    commands += recoil::data_block(name, rows);
    const recoil::style::Marker& marker = recoil::style::markers[k];
    plots += fmt::format("{}${} using 1:2 with linespoints lc rgb '{}' lw 2 pt {} ps 0.9 title {}",
                         k == 0 ? "plot " : ", ", name, marker.colour, marker.point,
                         recoil::gnuplot_text(curve.label));
  }
  return commands +
         "set size 0.36,1\nset origin 0,0\nset lmargin at screen 0.07\nset rmargin at screen "
         "0.33\n"
         "set tmargin at screen 0.86\nset bmargin at screen 0.30\n"
         "set logscale x\nset xrange [4.5:45]\nset xtics (5, 10, 20, 40)\nset yrange [0:102]\n"
         "set ytics 20\nset xlabel 'signal-to-noise of the misfit left'\nset ylabel 'data sets "
         "[%]'\n"
         "set key at screen 0.2,0.01 center bottom vertical Left reverse samplen 1.4\n"
         "set label 1 'One effect, several diameters' at graph 0,1.07 left font ',14'\n" +
         plots + "\n";
}

std::string heat_panel(const std::vector<Answered>& answers) {
  const Confusion c = confusion_of(answers);
  const double columns = static_cast<double>(c.columns.size());
  const double rows = static_cast<double>(c.rows.size());
  std::vector<std::vector<double>> cells;
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    double sum = 0.0;
    for (const int n : c.counts[r]) sum += n;
    for (std::size_t k = 0; k < c.columns.size(); ++k) {
      cells.push_back({static_cast<double>(k), rows - 1.0 - static_cast<double>(r),
                       sum > 0.0 ? 100.0 * c.counts[r][k] / sum : 0.0});
    }
  }
  std::string ticks = "set xtics rotate by 90 right (";
  for (std::size_t k = 0; k < c.columns.size(); ++k) {
    ticks += fmt::format("{}{} {}", k == 0 ? "" : ", ", recoil::gnuplot_text(c.columns[k]), k);
  }
  ticks += ") font ',10'\nset ytics (";
  for (std::size_t r = 0; r < c.rows.size(); ++r) {
    ticks += fmt::format("{}{} {}", r == 0 ? "" : ", ", recoil::gnuplot_text(c.rows[r]),
                         rows - 1.0 - static_cast<double>(r));
  }
  ticks += ") font ',10'\n";
  return recoil::data_block("cells", cells) +
         "reset\nset border 0\nset tics scale 0\nunset key\nunset grid\n"
         "set size 0.64,1\nset origin 0.36,0\nset lmargin at screen 0.5\n"
         "set rmargin at screen 0.93\nset tmargin at screen 0.92\nset bmargin at screen 0.3\n" +
         fmt::format("set xrange [-0.5:{:.1f}]\nset yrange [-0.5:{:.1f}]\n", columns - 0.5,
                     rows - 0.5) +
         ticks +
         "set label 1 'Hidden (rows) and answered (columns), snr 10 and more' at graph 0,1.03 left "
         "font ',14'\n"
         "set cbrange [0:100]\nset cbtics 25 font ',10'\nset format cb '%g %%'\n"
         "set palette defined (0 '#ffffff', 0.01 '#e8f1f8', 1 '#0072B2')\n"
         "plot $cells using 1:2:3 with image pixels\n";
}

}  // namespace

Confusion confusion_of(const std::vector<Answered>& answers) {
  Confusion c;
  std::vector<std::string> ids;
  for (const HiddenEffect& effect : hidden_effects()) {
    if (effect.kind == EffectKind::careless) continue;
    c.rows.emplace_back(effect.id);
    if (effect.kind != EffectKind::outside) ids.emplace_back(effect.id);
  }
  c.rows.emplace_back("nothing");
  c.columns = ids;
  const std::vector<Mark> others = {Mark::inside, Mark::outside, Mark::unexplained, Mark::nothing,
                                    Mark::failed};
  for (const Mark mark : others) c.columns.push_back(to_string(mark));
  c.counts.assign(c.rows.size(), std::vector<int>(c.columns.size(), 0));
  const auto index = [](const std::vector<std::string>& list, const std::string& word) {
    return static_cast<std::size_t>(std::find(list.begin(), list.end(), word) - list.begin());
  };
  for (const Answered& a : answers) {
    const Arm arm = arm_of(a.order);
    if (!a.reached || arm == Arm::pair || arm == Arm::single) continue;
    if (arm != Arm::correct && a.order.signal_to_noise < visible) continue;
    const std::size_t row =
        index(c.rows, a.order.effects.empty() ? "nothing" : a.order.effects.front());
    const Mark mark = mark_of(a);
    if (std::find(others.begin(), others.end(), mark) != others.end()) {
      ++c.counts[row][index(c.columns, to_string(mark))];
      continue;
    }
    for (const std::string& name : a.named) {
      const std::size_t column = index(c.columns, name);
      if (column < c.columns.size()) ++c.counts[row][column];
    }
  }
  return c;
}

std::string study_picture(const std::vector<Answered>& answers) {
  recoil::PlotScript script;
  script.name = "hidden-effects";
  script.title = "Power of the diagnosis against strength, and what is taken for what";
  script.width = 1240;
  script.height = 640;
  script.commands = recoil::style::preamble() + "set multiplot\n" + power_panel(answers) +
                    heat_panel(answers) + "unset multiplot\n";
  return recoil::draw_svg(script) + "\n";
}

}  // namespace hidden
