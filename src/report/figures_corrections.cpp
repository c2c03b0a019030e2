#include "report/figures_corrections.hpp"

#include <fmt/format.h>

#include <array>

#include "report/corrections_document.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr std::array<plot::Marker, 5> looks = {{{plot::blue, plot::Mark::dot},
                                                {plot::orange, plot::Mark::square},
                                                {plot::green, plot::Mark::triangle},
                                                {plot::purple, plot::Mark::diamond},
                                                {plot::grey, plot::Mark::circle}}};
constexpr std::array<const char*, 5> correction_names = {
    "all corrections", "at the plane", "second impacts in", "captures not counted", "none of them"};

plot::Picture picture_of(const char* name, std::size_t index, plot::Plot shown) {
  plot::Picture picture;
  picture.name = fmt::format("corrections-{}-{}", name, index);
  picture.title = shown.heading;
  picture.height = 390;
  picture.plots = {std::move(shown)};
  return picture;
}

Figure error_figure(const CorrectionStudy& study, std::size_t index) {
  plot::Plot shown;
  shown.heading = "Mean restitution less the truth";
  shown.remark = study_words(study);
  shown.x = {"incident velocity V", "m/s"};
  shown.x.logarithmic = true;
  shown.x.set_range({study.velocities.front() / 1.15, study.velocities.back() * 1.15});
  shown.y = {"e - truth"};
  shown.key = {plot::KeyPlace::below, 2};
  shown.layers.push_back(plot::Rule{plot::Direction::horizontal, 0.0, {plot::ink, 1.0}});
  std::vector<double> errors = {0.0};
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    // The mean of the rebounds is the same whether the captured are counted or not.
    if (study.rows[k].left_out == Correction::survivors) continue;
    plot::Line line{{}, {}, {looks[k].colour, 1.5}, looks[k].mark, 0.5};
    line.name = correction_names[k];
    for (std::size_t i = 0; i < study.velocities.size(); ++i) {
      if (!study.rows[k].error[i]) continue;
      line.x.push_back(study.velocities[i]);
      line.y.push_back(*study.rows[k].error[i]);
      errors.push_back(*study.rows[k].error[i]);
    }
    shown.layers.push_back(std::move(line));
  }
  shown.y.set_range(plot::range_of(errors, 0.08));
  shown.y.about = 5;
  const std::string caption = fmt::format(
      "{}. Mean over the rebounds at each velocity: e less the recipe's truth at the point's own "
      "diameter and velocity; zero is right. All lines rest on the same passages, so chance plays "
      "no part in their differences. Not counting captures leaves e as it is.",
      study_words(study));
  return figure_of(picture_of("e", index, std::move(shown)), caption);
}

Figure damping_figure(const CorrectionStudy& study, std::size_t index) {
  std::vector<double> values = {0.0, study.C_A};
  for (const CorrectionRow& row : study.rows) {
    if (row.usable) values.insert(values.end(), {row.C_A + row.C_A_sd, row.C_A - row.C_A_sd});
  }
  plot::Plot shown;
  shown.heading = "The fitted damping of the adhesion";
  shown.x = {"C_A", "s/m; vertical line: the truth"};
  shown.x.set_range(plot::range_of(values, 0.08));
  shown.x.about = 5;
  shown.y.set_range({static_cast<double>(study.rows.size()), -1.0});
  shown.layers.push_back(plot::Rule{plot::Direction::vertical, study.C_A, {plot::ink, 1.4}});
  for (std::size_t k = 0; k < study.rows.size(); ++k) {
    const double place = static_cast<double>(k);
    shown.y.ticks.push_back({place, correction_names[k]});
    const CorrectionRow& row = study.rows[k];
    if (!row.usable) continue;
    shown.layers.push_back(plot::Line{
        {row.C_A - row.C_A_sd, row.C_A + row.C_A_sd}, {place, place}, {looks[k].colour, 2.0}});
    plot::Points point{{row.C_A}, {place}};
    point.marker = looks[k];
    point.size = 0.9;
    shown.layers.push_back(std::move(point));
  }
  return figure_of(picture_of("damping", index, std::move(shown)),
                   say("{C_A} with one standard error (none where it rests on its bound), from the "
                       "points made in each way. The line is the value in the recipe."));
}

}  // namespace

std::vector<Figure> correction_figures(const CorrectionStudy& study, std::size_t index) {
  return {error_figure(study, index), damping_figure(study, index)};
}

}  // namespace recoil
