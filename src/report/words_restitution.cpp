#include "report/words_restitution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "core/units.hpp"
#include "data/text.hpp"
#include "estimate/friction.hpp"
#include "estimate/restitution_summary.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr std::size_t most_listed = 4;   // sizes in a sentence
constexpr std::size_t most_ranked = 10;  // series in a sentence
constexpr double scatter_level = 0.01;
constexpr double shown_level = 0.05;  // a smaller p-value is reported as a difference

/// The name of a series, with its size if there are several sizes, and with its dataset if there
/// are several.
std::string series_words(const RestitutionMean& mean, const RestitutionSummary& summary,
                         const std::vector<Dataset>& datasets) {
  const Dataset& dataset = datasets[mean.dataset];
  std::string name = dataset.series[mean.series];
  const bool sizes = std::ranges::any_of(
      summary.means, [&](const RestitutionMean& other) { return other.diameter != mean.diameter; });
  if (sizes) {
    // One series of all sizes has no need of its name.
    name = dataset.series.size() > 1 ? name + " " + diameter_words(mean.diameter)
                                     : diameter_words(mean.diameter);
  }
  return datasets.size() > 1 ? fmt::format("{} of {}", name, dataset.id) : name;
}

bool spans_a_decade(const RestitutionSummary& summary) {
  return summary.velocities[1] >= 10.0 * summary.velocities[0];
}

Sentence mean_words(const RestitutionMean& mean) {
  Number value{mean.value, padded(3)};
  if (mean.interval) value.band = {(*mean.interval)[0], (*mean.interval)[1]};
  return value.words();
}

Sentence ends_words(const TestedEffect& effect, double sign) {
  const double a = sign * (*effect.interval)[0];
  const double b = sign * (*effect.interval)[1];
  return say("[{:.2g}, {:.2g}]", std::min(a, b), std::max(a, b));
}

/// The dependence of e on V. If V spans a decade, the sentence includes the range of e.
Sentence dependence_words(const RestitutionSummary& summary) {
  const TestedEffect& effect = summary.velocity;
  if (!effect.p_value) {
    std::string why = effect.why;
    why.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(why.front())));
    return say("{}: the dependence of {e} on {V} is unknown.", why);
  }
  const std::string p = p_words(*effect.p_value);
  const bool steady = *effect.p_value < shown_level;
  const bool bent = summary.bend.value_or(1.0) < shown_level;
  if (!steady && !bent) {
    return say("No dependence of {e} on {V} is detected: {:.2g} {} per decade of {V} ({}).",
               *effect.value, ends_words(effect, 1.0), p);
  }
  const double sign = *effect.value < 0.0 ? -1.0 : 1.0;
  const char* const goes = sign < 0.0 ? "falls" : "rises";
  const Sentence slope =
      say("by {:.2g} {} per decade of {V} ({})", sign * *effect.value, ends_words(effect, sign), p);
  const Sentence no_slope =
      say("without a steady rise or fall ({})", p_words(summary.bend.value_or(1.0)));
  if (!spans_a_decade(summary)) {
    return steady ? say("{e} {} {}.", goes, slope) : say("{e} varies with {V}, {}.", no_slope);
  }
  const Sentence range =
      say("{e} depends on {V}: {:.3f} to {:.3f} for {V} = {:.3g} to {:.3g} m/s", summary.values[0],
          summary.values[1], summary.velocities[0], summary.velocities[1]);
  return steady ? range + say("; it {} {}.", goes, slope) : range + say(", {}.", no_slope);
}

/// "0.37 at 1.3 m/s"
Sentence end_words(const RestitutionRange::End& end) {
  return say("{:.2f} at {} m/s", end.value, number(end.velocity, 2));
}

/// "rises from 0.37 at 1.3 m/s to 0.87 at 10 m/s (2 um)"
Sentence range_words(const RestitutionRange& range, const std::vector<Dataset>& datasets) {
  Sentence size = diameter_sentence(range.diameter);
  if (datasets.size() > 1) size += " on " + short_name(datasets, range.dataset);
  if (range.settings < 2) return say("is {} ({})", end_words(range.slowest), size);
  if (range.peaks()) {
    return say("rises from {} to {} and falls to {} ({})", end_words(range.slowest),
               end_words(range.largest), end_words(range.fastest), size);
  }
  const bool falls = range.fastest.value < range.slowest.value;
  return say("{} from {} to {} ({})", falls ? "falls" : "rises", end_words(range.slowest),
             end_words(range.fastest), size);
}

/// What was measured where e is no line: e at the ends of every size.
Sentence ranges_words(std::vector<RestitutionRange> ranges, const std::vector<Dataset>& datasets) {
  const bool followed =
      std::ranges::any_of(ranges, [](const RestitutionRange& range) { return range.settings > 1; });
  if (followed) std::erase_if(ranges, [](const RestitutionRange& one) { return one.settings < 2; });
  std::ranges::stable_sort(ranges, {}, &RestitutionRange::diameter);
  const std::size_t sizes = ranges.size();
  if (sizes > most_listed) ranges = {ranges.front(), ranges.back()};
  std::vector<Sentence> parts;
  for (const RestitutionRange& range : ranges) parts.push_back(range_words(range, datasets));
  return say("{e} {}{}.", join(parts, "; "),
             sizes > most_listed ? fmt::format("; smallest and largest of {} sizes", sizes)
                                 : std::string());
}

/// "(24 points, 12 launches)"
std::string count_words(const RestitutionMean& mean) {
  const std::string points = counted(mean.points, "point");
  return mean.launches > 1 ? fmt::format(" ({}, {} launches)", points, mean.launches)
                           : fmt::format(" ({})", points);
}

/// The setting or launch that lies apart, and for a drop height the error that would explain it.
Sentence outlier_words(const OutlyingBatch& batch, const std::vector<Dataset>& datasets) {
  const Dataset& dataset = datasets[batch.dataset];
  const std::string points = counted(batch.points, "point");
  const std::string where =
      (dataset.series.size() > 1 ? " of " + dataset.series[batch.series] : std::string()) +
      (datasets.size() > 1 ? " of " + dataset.id : std::string());
  const Sentence apart = say("lie together {:.2g} {} the others ({})", std::abs(batch.difference),
                             batch.difference > 0.0 ? "above" : "below", p_words(batch.p_value));
  if (batch.launch) {
    return say("The {} of launch {}{} {}: look there.", points, batch.name, where, apart);
  }
  const double error = std::abs(batch.height_error);
  if (dataset.system.method == Method::drop_heights && batch.height) {
    return say("The {} from {} cm{} {}: that height is wrong by about {} cm, or look there.",
               points, number(*batch.height / units::cm, 6), where, apart,
               number(error * *batch.height / units::cm, 1));
  }
  const Sentence there =
      say("The {} at {} m/s{} {}: ", points, number(batch.velocity, 3), where, apart);
  if (dataset.system.method != Method::drop_heights) return there + say("look there.");
  return there +
         say("the drop height is wrong by about {} %, or look there.", number(100.0 * error, 1));
}

/// Does the fitted law follow the points that lie apart: does it leave less than half of their
/// difference?
bool explains(const FitResult& fitted, const OutlyingBatch& batch,
              const std::vector<Dataset>& datasets) {
  std::set<int> lines;
  for (const ImpactPoint& point : datasets[batch.dataset].points) {
    const bool named = (batch.launch ? point.launch : point.setting) == batch.name;
    const double away = std::abs(point.incident_velocity - batch.velocity);
    const bool there = !batch.name.empty() || away < 1e-9 * batch.velocity;
    if (point.series == batch.series && named && there) lines.insert(point.line);
  }
  double rest = 0.0, count = 0.0;
  for (std::size_t i = 0; i < fitted.data.points.size(); ++i) {
    const Observation& point = fitted.data.points[i];
    if (point.dataset != batch.dataset || point.censored || !lines.contains(point.line)) continue;
    rest += point.restitution - fitted.prediction[i];
    count += 1.0;
  }
  return count > 0.0 && std::abs(rest / count) < 0.5 * std::abs(batch.difference);
}

std::vector<Sentence> sentences_of(const RestitutionSummary& summary,
                                   const std::vector<Dataset>& datasets, bool adhesion) {
  if (adhesion && !summary.ranges.empty()) return {ranges_words(summary.ranges, datasets)};
  std::vector<RestitutionMean> ranked;
  for (const RestitutionMean& mean : summary.means) {
    if (!mean.velocity) ranked.push_back(mean);
  }
  std::ranges::stable_sort(ranked, std::greater(), &RestitutionMean::value);
  std::vector<Sentence> means;
  for (const RestitutionMean& mean : ranked) {
    means.push_back(summary.several_series ? say("{} {}{}", series_words(mean, summary, datasets),
                                                 mean_words(mean), count_words(mean))
                                           : mean_words(mean) + count_words(mean));
  }
  if (means.empty()) return {};
  std::vector<Sentence> sentences;
  const bool depends = summary.velocity.p_value.value_or(1.0) < shown_level ||
                       summary.bend.value_or(1.0) < shown_level;
  if (!depends || !spans_a_decade(summary)) {
    sentences.push_back(
        means.size() > most_ranked
            ? say("Mean {e} of {} series or sizes: {:.3f} ({}) to {:.3f} ({}).", means.size(),
                  ranked.back().value, series_words(ranked.back(), summary, datasets),
                  ranked.front().value, series_words(ranked.front(), summary, datasets))
            : say("Mean {e}: {}.", join(means, "; ")));
  }
  if (summary.outlier) sentences.push_back(outlier_words(*summary.outlier, datasets));
  sentences.push_back(dependence_words(summary));
  if (summary.scatter && summary.scatter->p_value < scatter_level) {
    sentences.push_back(say("The points scatter {:.2g} times as much as they state ({}).",
                            summary.scatter->ratio, p_words(summary.scatter->p_value)));
  }
  if (summary.without_error > 0) {
    sentences.push_back(say("{} of {} points {} no error and {} with the median of the others.",
                            summary.without_error, summary.rebounds,
                            summary.without_error == 1 ? "states" : "state",
                            summary.without_error == 1 ? "counts" : "count"));
  }
  const TestedEffect& differ = summary.series;
  if (differ.p_value) {
    const std::string p = p_words(*differ.p_value);
    const auto name = [&](std::size_t k) {
      return series_words(summary.means[summary.most_different[k]], summary, datasets);
    };
    if (*differ.p_value >= shown_level) {
      sentences.push_back(say("No difference between the series is detected ({}).", p));
    } else if (means.size() > most_ranked) {
      sentences.push_back(say("The series differ in {e} ({}), by up to {:.2g}.", p, *differ.value));
    } else {
      sentences.push_back(say("The series differ in {e} ({}): {} and {} by {:.2g} {}.", p, name(0),
                              name(1), *differ.value, ends_words(differ, 1.0)));
    }
  }
  return sentences;
}

}  // namespace

std::vector<Sentence> restitution_sentences(const std::vector<Dataset>& datasets,
                                            const FitResult& fitted) {
  const bool adhesion = adheres_anywhere(fitted.model);
  RestitutionSummary summary = summarise_restitution(datasets, adhesion);
  if (summary.outlier && explains(fitted, *summary.outlier, datasets)) summary.outlier.reset();
  return sentences_of(summary, datasets, adhesion);
}

std::vector<Sentence> restitution_sentences(const std::vector<Dataset>& datasets, bool adhesion) {
  return sentences_of(summarise_restitution(datasets, adhesion), datasets, adhesion);
}

std::vector<Sentence> friction_sentences(const std::vector<Dataset>& datasets) {
  std::vector<Sentence> sentences;
  for (const Dataset& dataset : datasets) {
    const std::optional<Friction> found = fit_friction(dataset);
    if (!found) continue;
    const std::string on = datasets.size() > 1 ? " on " + dataset.id : "";
    const std::string points = counted(static_cast<long long>(found->points), "point");
    if (!found->mu) {
      sentences.push_back(
          say("Friction{}: the tangential restitutions of {} agree with rolling, so only a lower "
              "limit is known, mu at least {:.2g}.",
              on, points, *found->least));
      continue;
    }
    Number mu{*found->mu, padded(3)};
    if (found->interval) mu.band = {(*found->interval)[0], (*found->interval)[1]};
    sentences.push_back(say(
        "Friction{}: mu = {} from the tangential restitutions of {}, of which "
        "{} slid to the end{}.",
        on, mu, points, found->sliding, found->interval ? "" : " (one point gives no interval)"));
  }
  return sentences;
}

Table restitution_table(const std::vector<Dataset>& datasets) {
  const RestitutionSummary summary = summarise_restitution(datasets);
  Table table;
  if (summary.means.size() < 2) return table;
  const SizeUnit sizes = size_unit(datasets);
  table.caption = say("Mean {e} of every series and setting, with 95 % intervals");
  table.columns = {{"series", "", true},  {say("{d}"), sizes.name},
                   {"setting", "", true}, {say("{V}"), "m/s"},
                   {say("{e}")},          {"points"}};
  for (const RestitutionMean& mean : summary.means) {
    table.rows.push_back({Sentence(datasets[mean.dataset].series[mean.series]),
                          Sentence(size_text(mean.diameter, sizes)),
                          mean.setting.empty() ? Cell() : Cell(Sentence(mean.setting)),
                          mean.velocity ? Cell(Number{*mean.velocity, significant(4)}) : Cell(),
                          mean_words(mean), whole(mean.points)});
  }
  return table;
}

}  // namespace recoil
