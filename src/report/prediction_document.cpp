#include "report/prediction_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "document/terminal.hpp"
#include "report/figures_capture.hpp"
#include "report/figures_mixture.hpp"
#include "report/format.hpp"
#include "report/words_dataset.hpp"
#include "report/words_predict.hpp"

namespace recoil {
namespace {

constexpr std::size_t rows_shown = 14;

Cell banded(const BandedValue& at, const Notation& notation) {
  if (!at.value) return {};
  Number quantity{*at.value, notation};
  if (at.lower && at.upper) quantity.band = {*at.lower, *at.upper};
  return quantity;
}

/// The averages under the three conventions at some velocities, beside d10 alone.
Table averages_table(const PolydispersePrediction& mixture) {
  Table table;
  table.caption = mixture.replicates > 0
                      ? say("Mean restitution by convention, and captures, with pointwise {} bands "
                            "of {} replicates",
                            percent(mixture.level), mixture.replicates)
                      : Sentence(
                            "Mean restitution by convention, and captures, without bands: no "
                            "bootstrap");
  table.columns = {{say("{V}"), "m/s"},        {say("{d10} alone")}, {"captured as 0"},
                   {"captured left out"},      {"unseen left out"},  {"captured", "%"},
                   {"captured or unseen", "%"}};
  Notation whole_percent = fixed(0);
  whole_percent.scale = 100.0;
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

/// How far the points lie from each curve.
Table misses_table(const PolydispersePrediction& mixture) {
  Table table;
  table.caption = "Distance of the points from each curve";
  table.columns = {{"curve"}, {say("rms of {e}")}, {"points with a prediction"}};
  const auto add = [&](const Sentence& curve, const CurveMiss& miss) {
    table.rows.push_back({curve, cell_if(number_if(miss.rmse, padded(2))),
                          Number{static_cast<double>(miss.points), fixed(0)}});
  };
  add(say("{d10} alone"), mixture.miss_single);
  for (std::size_t c = 0; c < all_conventions.size(); ++c) {
    add(words_of(all_conventions[c]), mixture.miss[c]);
  }
  return table;
}

/// The largest difference between two averages where both are, and where [m/s].
struct Difference {
  double value = 0.0;
  double velocity = 0.0;
};
Difference largest_difference(const PolydispersePrediction& mixture) {
  Difference largest;
  for (std::size_t k = 0; k < mixture.velocity.size(); ++k) {
    const auto& low = mixture.average[0][k].value;
    const auto& high = mixture.average[2][k].value;
    if (low && high && *high - *low > largest.value) {
      largest = {*high - *low, mixture.velocity[k]};
    }
  }
  return largest;
}

}  // namespace

std::vector<Sentence> mixture_words(const Analysis& analysis,
                                    const PolydispersePrediction& mixture) {
  std::vector<Sentence> words;
  words.push_back(
      say("{} bins from {} to {} {um} in {} sizes, {d10} = {} {um}; capture below {} m/s at the "
          "lower end and {} m/s "
          "at the upper",
          mixture.sizes.bins.size(), diameter_text(mixture.sizes.smallest),
          diameter_text(mixture.sizes.largest), mixture.simulated,
          diameter_text(mixture.sizes.mean_diameter()),
          number(mixture.size_curves.front().capture_velocity, 3),
          number(mixture.size_curves.back().capture_velocity, 3)));
  if (!mixture.sizes.description.empty()) {
    words.push_back("the size distribution: " + mixture.sizes.description);
  }
  const Difference apart = largest_difference(mixture);
  if (apart.value > 0.0) {
    words.push_back(
        say("the three conventions differ most at {} m/s, by {} in {e}; the paper does not "
            "say which of "
            "them its weighted average is",
            number(apart.velocity, 3), digits(apart.value, 2)));
  }
  std::vector<std::pair<double, std::string>> misses;
  for (std::size_t c = 0; c < all_conventions.size(); ++c) {
    if (mixture.miss[c].rmse) {
      misses.emplace_back(*mixture.miss[c].rmse, words_of(all_conventions[c]));
    }
  }
  if (!misses.empty() && mixture.miss_single.rmse) {
    const auto best = std::min_element(misses.begin(), misses.end());
    words.push_back(
        say("of the three averages the points of {} ({}) lie closest to that with {}: {} "
            "in {e} (root mean "
            "square), where {d10} alone misses by {}",
            analysis.datasets[mixture.dataset].id,
            to_string(analysis.datasets[mixture.dataset].provenance), best->second,
            digits(best->first, 2), digits(*mixture.miss_single.rmse, 2)));
  }
  words.emplace_back(
      "the parameters are those of the fit, which took every point as spheres of the one "
      "diameter "
      "that the dataset states; nothing was fitted to the mixture");
  return words;
}

std::vector<Section> prediction_sections(const Analysis& analysis,
                                         const PolydispersePrediction& mixture) {
  const Dataset& dataset = analysis.datasets[mixture.dataset];
  Section said{"mixture", "Mixture",
               say("{} with the parameters of {}", mixture.sizes.file.string(), analysis.spec.id)};
  said.blocks = {
      items({{"dataset", say("{}, {}: {}", dataset.id, to_string(dataset.provenance),
                             provenance_sentence(dataset.provenance))},
             {"origin of sizes",
              Sentence(mixture.sizes.provenance.empty() ? "not stated" : mixture.sizes.provenance)},
             {"measuring plane",
              say("{} mm above the surface: rebounds below {} m/s are not seen",
                  number(mixture.probe_height / units::mm, 3), number(mixture.slowest_seen, 3))}})};
  List sentences;
  for (const Sentence& words : mixture_words(analysis, mixture)) {
    sentences.entries.push_back(as_sentence(words));
  }
  said.blocks.emplace_back(std::move(sentences));
  return {std::move(said),
          {"averages", "Weighted averages", {}, {averages_table(mixture)}},
          {"misses", "Distance of the points", {}, {misses_table(mixture)}}};
}

std::string text_prediction(const Analysis& analysis, const PolydispersePrediction& mixture) {
  return terminal_text(prediction_sections(analysis, mixture));
}

std::vector<Block> mixture_blocks(const Analysis& analysis) {
  std::vector<Block> blocks;
  for (const PolydispersePrediction& mixture : analysis.mixtures) {
    std::vector<Sentence> sentences;
    for (const Sentence& words : mixture_words(analysis, mixture)) {
      sentences.push_back(as_sentence(words));
    }
    append(blocks, {Paragraph{join(sentences, " ")}, Figures{mixture_figures(analysis, mixture)},
                    misses_table(mixture), averages_table(mixture)});
  }
  return blocks;
}

std::vector<Block> capture_comparison_blocks(const Analysis& analysis) {
  Figures figures{capture_comparison_figures(analysis)};
  if (figures.figures.empty()) return {};
  return {Paragraph{"What the older models make of the same system. All that they take from these "
                    "points is one restitution; their energies follow from the elastic constants "
                    "and surface energies that the dataset states or that are estimated for it."},
          std::move(figures)};
}

}  // namespace recoil
