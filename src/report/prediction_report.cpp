#include "report/prediction_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/program.hpp"
#include "core/units.hpp"
#include "document/terminal.hpp"
#include "mechanism/mechanism.hpp"
#include "report/format.hpp"
#include "report/panels.hpp"
#include "report/result_entries.hpp"
#include "report/result_json.hpp"
#include "report/words_dataset.hpp"

namespace recoil {
namespace {

constexpr std::size_t rows_shown = 14;

// ---- pictures ----------------------------------------------------------------------------------

/// One stroke for each convention. Colours and dashes differ.
constexpr std::array<plot::Stroke, 3> strokes_of_averages = {{{plot::blue, 2.0},
                                                              {plot::green, 2.0, plot::long_dashes},
                                                              {plot::vermillion, 2.0, plot::dots}}};
constexpr std::array<const char*, 3> average_names = {"captured as e = 0", "captured left out",
                                                      "unseen left out"};

plot::Band band_of(const std::vector<double>& velocity, const std::vector<BandedValue>& values,
                   std::string_view colour) {
  plot::Band band{velocity, {}, {}, {std::string(colour), 0.2}};
  for (const BandedValue& value : values) {
    band.lower.push_back(value.lower.value_or(NAN));
    band.upper.push_back(value.upper.value_or(NAN));
  }
  return band;
}

plot::Line line_of(const std::vector<double>& velocity, const std::vector<BandedValue>& values,
                   const plot::Stroke& stroke, const std::string& name) {
  plot::Line line{velocity, {}, stroke};
  line.name = name;
  for (const BandedValue& value : values) line.y.push_back(value.value.value_or(NAN));
  return line;
}

void add_points(const Analysis& analysis, std::size_t dataset, plot::Plot& shown) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < analysis.fitted.data.points.size(); ++i) {
    if (analysis.fitted.data.points[i].dataset == dataset) indices.push_back(i);
  }
  const auto points = rebound_layer(analysis, point_columns(analysis, indices),
                                    to_string(analysis.datasets[dataset].provenance));
  if (points) shown.layers.push_back(*points);
}

// ---- tables and words ---------------------------------------------------------------------------

Cell banded(const BandedValue& at, const Notation& notation) {
  if (!at.value) return {};
  Number quantity{*at.value, notation};
  if (at.lower && at.upper) quantity.band = {*at.lower, *at.upper};
  return quantity;
}

/// The averages under the three conventions and the curve of d10 at some velocities.
Table averages_table(const PolydispersePrediction& mixture) {
  Table table;
  table.caption =
      mixture.replicates > 0
          ? say("Mean restitution by convention, and captures, with pointwise {} bands of {} "
                "replicates",
                percent(mixture.level), mixture.replicates)
          : Sentence("Mean restitution by convention, and captures, without bands: no bootstrap");
  table.columns = {{say("{V}"), "m/s"},        {say("{d10} alone")}, {"captured as 0"},
                   {"captured left out"},      {"unseen left out"},  {"captured", "%"},
                   {"captured or unseen", "%"}};
  const Notation whole_percent = in_percent(fixed(0), "");
  const std::size_t stride = std::max<std::size_t>(1, mixture.velocity.size() / rows_shown);
  for (std::size_t k = 0; k < mixture.velocity.size(); k += stride) {
    std::vector<Cell> row = {Number{mixture.velocity[k], padded(3)},
                             cell_if(number_if(mixture.size_curves[1].restitution[k], fixed(3)))};
    for (const auto& average : mixture.average) row.push_back(banded(average[k], fixed(3)));
    row.push_back(banded(mixture.captured[k], whole_percent));
    row.push_back(banded(mixture.unseen[k], whole_percent));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The rms distance of the points from each curve.
Table misses_table(const PolydispersePrediction& mixture) {
  Table table;
  table.caption = "Distance of the points from each curve";
  table.columns = {{"curve"}, {say("rms of {e}")}, {"points with a prediction"}};
  const auto add = [&](const Sentence& curve, const CurveMiss& miss) {
    table.rows.push_back({curve, cell_if(number_if(miss.rmse, padded(2))), whole(miss.points)});
  };
  add(say("{d10} alone"), mixture.miss_single);
  for (std::size_t c = 0; c < capture_conventions.size(); ++c) {
    add(capture_conventions[c].words, mixture.miss[c]);
  }
  return table;
}

/// The largest difference between the first and the last convention.
struct Difference {
  double value = 0.0;     ///< [1]
  double velocity = 0.0;  ///< [m/s]
};
Difference largest_difference(const PolydispersePrediction& mixture) {
  Difference largest;
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    const auto& low = mixture.average[0][k].value;
    const auto& high = mixture.average[2][k].value;
    if (low && high && *high - *low > largest.value) largest = {*high - *low, mixture.velocity[k]};
  }
  return largest;
}

/// The difference between the conventions, and the convention nearest to the points.
std::vector<Sentence> mixture_words(const Analysis& analysis,
                                    const PolydispersePrediction& mixture) {
  std::vector<Sentence> words = {
      say("{} to {} {um} in {} sizes, {d10} = {} {um}; capture below {} m/s for the smallest and "
          "{} m/s for the largest",
          diameter_text(mixture.sizes.smallest), diameter_text(mixture.sizes.largest),
          mixture.simulated, diameter_text(mixture.sizes.mean_diameter()),
          number(mixture.size_curves.front().capture_velocity, 3),
          number(mixture.size_curves.back().capture_velocity, 3))};
  if (!mixture.sizes.description.empty()) words.emplace_back(mixture.sizes.description);
  const Difference apart = largest_difference(mixture);
  if (apart.value > 0.0) {
    words.push_back(say("the three conventions differ by up to {} in {e}, at {} m/s",
                        digits(apart.value, 2), number(apart.velocity, 3)));
  }
  std::vector<std::pair<double, std::string_view>> misses;
  for (std::size_t c = 0; c < capture_conventions.size(); ++c) {
    if (mixture.miss[c].rmse) {
      misses.emplace_back(*mixture.miss[c].rmse, capture_conventions[c].words);
    }
  }
  if (!misses.empty() && mixture.miss_single.rmse) {
    const auto best = std::ranges::min_element(misses);
    words.push_back(
        say("the points are closest to the average with {}: rms difference {} in {e}, for {d10} "
            "alone {}",
            best->second, digits(best->first, 2), digits(*mixture.miss_single.rmse, 2)));
  }
  const ImpactModel& model = analysis.fitted.model;
  const bool averages = averages_over_sizes(model, mixture.dataset) ||
                        std::ranges::any_of(model.chain, [](const Mechanism* mechanism) {
                          return mechanism->info.mixes_sizes;
                        });
  if (!averages) {
    words.emplace_back("the fit uses one diameter per point; the mixture is not fitted");
  }
  return words;
}

std::vector<Section> prediction_sections(const Analysis& analysis,
                                         const PolydispersePrediction& mixture) {
  const Dataset& dataset = analysis.datasets[mixture.dataset];
  Section mixture_section{
      "mixture", "Mixture",
      say("{} with the parameters of {}", mixture.sizes.file.string(), analysis.spec.id)};
  mixture_section.blocks = {
      items({{"dataset", say("{}, {}: {}", dataset.id, to_string(dataset.provenance),
                             provenance_sentence(dataset.provenance))},
             {"origin of sizes",
              Sentence(mixture.sizes.provenance.empty() ? "not stated" : mixture.sizes.provenance)},
             {"measuring plane",
              say("{} mm above the surface: rebounds below {} m/s are not detected",
                  number(mixture.probe_height / units::mm, 3), number(mixture.slowest_seen, 3))}})};
  mixture_section.blocks.emplace_back(list_of_sentences(mixture_words(analysis, mixture)));
  return {std::move(mixture_section),
          shown_section("averages", "Weighted averages", {averages_table(mixture)}),
          shown_section("misses", "Distance of the points", {misses_table(mixture)})};
}

std::string cell(const std::optional<double>& value) {
  return value ? fmt::format("{:.6g}", *value) : std::string();
}

std::string cells(const BandedValue& at) {
  return fmt::format(",{},{},{}", cell(at.value), cell(at.lower), cell(at.upper));
}

PredictionFile::Banded banded_entry(const BandedValue& at) {
  PredictionFile::Banded out = {.value = at.value};
  if (at.lower && at.upper) out.band = {*at.lower, *at.upper};
  return out;
}

}  // namespace

Figure mixture_figure(const Analysis& analysis, const PolydispersePrediction& mixture) {
  plot::Plot shown;
  shown.heading = "Weighted averages over the sizes";
  if (analysis.datasets.size() > 1) shown.remark = analysis.datasets[mixture.dataset].id;
  shown.x = velocity_axis({mixture.velocity.front(), mixture.velocity.back()});
  shown.y = restitution_axis({0.0, 1.05});
  shown.key = plot::KeyPlace::below;
  for (std::size_t k = 0; k < capture_conventions.size(); ++k) {
    shown.layers.push_back(
        band_of(mixture.velocity, mixture.average[k], strokes_of_averages[k].colour));
  }
  for (std::size_t k = 0; k < capture_conventions.size(); ++k) {
    shown.layers.push_back(
        line_of(mixture.velocity, mixture.average[k], strokes_of_averages[k], average_names[k]));
  }
  const SizeCurve& mean = mixture.size_curves[1];
  plot::Line single{mixture.velocity, mean.restitution, {plot::grey, 1.4}};
  single.name = fmt::format("d10 = {} µm alone", diameter_text(mean.diameter));
  shown.layers.push_back(std::move(single));
  add_points(analysis, mixture.dataset, shown);
  const std::string caption = fmt::format(
      "The average over {} sizes under three conventions, with pointwise {} bands. Unseen: "
      "rebounds below {} m/s, which do not reach the measuring plane.",
      mixture.simulated, percent(mixture.level), number(mixture.slowest_seen, 3));
  const std::string title = shown.heading + ", " + analysis.datasets[mixture.dataset].id;
  return figure_of({.name = fmt::format("mixture-average-{}", mixture.dataset + 1),
                    .title = title,
                    .height = 390,
                    .plots = {std::move(shown)}},
                   caption);
}

std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture) {
  return terminal_text(prediction_sections(analysis, mixture));
}

Blocks mixture_blocks(const Analysis& analysis) {
  Blocks blocks;
  for (const PolydispersePrediction& mixture : analysis.mixtures) {
    append(blocks, {Figures{{mixture_figure(analysis, mixture)}},
                    list_of_sentences(mixture_words(analysis, mixture)), misses_table(mixture)});
  }
  return blocks;
}

std::string csv_prediction(const PolydispersePrediction& mixture) {
  std::string csv = "incident_velocity_m_s,restitution_d10";
  for (const CaptureConvention& convention : capture_conventions) {
    csv += fmt::format(",{0},{0}_lower,{0}_upper", convention.name);
  }
  for (const char* part : {"captured_fraction", "unseen_fraction"}) {
    csv += fmt::format(",{0},{0}_lower,{0}_upper", part);
  }
  csv += '\n';
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    const double single = mixture.size_curves[1].restitution[k];
    csv += fmt::format("{:.6g},{}", mixture.velocity[k],
                       std::isfinite(single) ? fmt::format("{:.6g}", single) : std::string());
    for (const auto& average : mixture.average) csv += cells(average[k]);
    csv += cells(mixture.captured[k]) + cells(mixture.unseen[k]) + '\n';
  }
  return csv;
}

std::string json_prediction(const Analysis& analysis, const PolydispersePrediction& mixture) {
  const auto miss_of = [](const CurveMiss& miss) {
    return PredictionFile::Miss{miss.rmse, miss.points};
  };
  const auto convention = [&](std::size_t c) {
    return PredictionFile::Convention{std::string(capture_conventions[c].words),
                                      miss_of(mixture.miss[c])};
  };
  PredictionFile out = {.recoil = version(),
                        .fit = analysis.spec.id,
                        .dataset = dataset_reference(analysis.datasets[mixture.dataset]),
                        .sizes = {.file = mixture.sizes.file.string(),
                                  .provenance = mixture.sizes.provenance,
                                  .description = mixture.sizes.description,
                                  .sha256 = mixture.sizes.sha256,
                                  .d10_um = mixture.sizes.mean_diameter() / units::um,
                                  .simulated = mixture.simulated},
                        .probe_height_m = mixture.probe_height,
                        .slowest_seen_m_s = mixture.slowest_seen,
                        .level = mixture.level,
                        .replicates = mixture.replicates,
                        .seed = analysis.uncertainty.bootstrap.seed,
                        .conventions = {.captured_as_zero = convention(0),
                                        .captured_left_out = convention(1),
                                        .unseen_left_out = convention(2)},
                        .d10_alone = {miss_of(mixture.miss_single)}};
  for (const SizeBin& bin : mixture.sizes.bins) {
    out.sizes.bins.push_back({bin.diameter / units::um, bin.width / units::um, bin.weight});
  }
  for (const SizeCurve& size : mixture.size_curves) {
    out.size_curves.push_back({.name = std::string(size.name),
                               .diameter_um = size.diameter / units::um,
                               .capture_velocity = size.capture_velocity,
                               .restitution = {size.restitution.begin(), size.restitution.end()}});
  }
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    out.curve.push_back({.incident_velocity = mixture.velocity[k],
                         .captured_as_zero = banded_entry(mixture.average[0][k]),
                         .captured_left_out = banded_entry(mixture.average[1][k]),
                         .unseen_left_out = banded_entry(mixture.average[2][k]),
                         .captured_fraction = banded_entry(mixture.captured[k]),
                         .unseen_fraction = banded_entry(mixture.unseen[k])});
  }
  return text_of(out);
}

}  // namespace recoil
