#include "report/posterior_report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/units.hpp"
#include "report/fit_tables.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

const PosteriorResult* sampled(const Analysis& a) {
  return a.uncertainty.posterior ? &*a.uncertainty.posterior : nullptr;
}

std::string capture_label(const Analysis& a, const CaptureEstimate& at) {
  const std::string where = a.datasets.size() > 1 ? ", " + a.datasets[at.dataset].id : "";
  return fmt::format("V*({:.4g} um{})", at.diameter / units::um, where);
}

}  // namespace

std::string no_posterior_words(const PosteriorResult& posterior) {
  if (posterior.available()) return {};
  switch (*posterior.missing) {
    case NoPosterior::no_walkers:
      return "no posterior: near the estimate the model mostly has no answer";
    case NoPosterior::not_settled:
      return fmt::format("no posterior: the draws have not settled after {} steps of every walker",
                         posterior.steps);
    case NoPosterior::few_points:
      return "no posterior: the noise is unknown, and there are no more points than parameters";
  }
  return {};
}

Table posterior_table(const Analysis& a) {
  Table table;
  const PosteriorResult* const found = sampled(a);
  if (found == nullptr || !found->available()) return table;
  table.caption =
      say("{} intervals of the posterior: equal tails, flat priors between the bounds, constants "
          "of the materials as stated; where the sampler has settled, R-hat is close to 1 and many "
          "draws are effective",
          percent(a.uncertainty.options.level));
  table.columns = {{"quantity"}, {"mean"}, {"sd"}, {"interval"}, {"R-hat"}, {"effective draws"}};
  const auto row = [&](Sentence name, const PosteriorMarginal& m, bool settled) {
    table.rows.push_back(
        {std::move(name), Number{m.mean, significant(4)}, Number{m.sd, significant(2)},
         m.interval.available() ? Cell(Sentence(NumberRange{*m.interval.lower, *m.interval.upper}))
                                : Cell(),
         settled ? Cell(Number{m.r_hat, fixed(4)}) : Cell(),
         settled ? Cell(Number{m.effective, fixed(0)}) : Cell()});
  };
  for (std::size_t j = 0; j < found->parameters.size(); ++j) {
    if (!a.fitted.model.slots[j].moves()) continue;
    row(labelled(a.fitted.model.slots[j]), found->parameters[j], true);
  }
  for (std::size_t k = 0; k < found->capture.size(); ++k) {
    row(Sentence(capture_label(a, a.uncertainty.capture[k]) + " [m/s]"), found->capture[k], false);
  }
  return table;
}

std::string posterior_csv(const Analysis& a) {
  const PosteriorResult* const found = sampled(a);
  std::string text;
  if (found == nullptr || !found->available()) return text;
  std::vector<std::size_t> moving;
  for (std::size_t j = 0; j < a.fitted.model.slots.size(); ++j) {
    if (!a.fitted.model.slots[j].moves()) continue;
    text += fmt::format("{}\"{}\"", moving.empty() ? "" : ",", a.fitted.model.slots[j].label());
    moving.push_back(j);
  }
  for (const CaptureEstimate& at : a.uncertainty.capture) {
    text += fmt::format(",\"{}\"", capture_label(a, at));
  }
  text += "\n";
  for (std::size_t k = 0; k < found->draws.size(); ++k) {
    for (const std::size_t j : moving) {
      text += fmt::format("{}{:.9g}", j == moving.front() ? "" : ",", found->draws[k][j]);
    }
    for (const double v : found->capture_draws[k]) {
      text += std::isfinite(v) ? fmt::format(",{:.9g}", v) : ",";
    }
    text += "\n";
  }
  return text;
}

}  // namespace recoil
