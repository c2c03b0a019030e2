#include "report/words_validity.hpp"

#include <fmt/format.h>

#include "core/units.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr double dmt_limit = 0.1;  // DMT holds for Tabor parameters below this

std::string impact_words(const Validity& v) {
  return fmt::format("{:.3g} m/s, {}", v.velocity, diameter_words(v.diameter));
}

std::string pressure_words(double pressure) {
  return pressure < units::GPa ? fmt::format("{:.2g} MPa", pressure / 1e6)
                               : fmt::format("{:.2g} GPa", pressure / units::GPa);
}

std::string tabor_words(const Validity& v) {
  const char* const model = "the model has the equilibrium of JKR";
  if (!v.exceeded()) return "adhesion acts inside the contact (JKR), as in the model";
  if (v.value < dmt_limit) return fmt::format("adhesion acts around the contact (DMT); {}", model);
  return fmt::format("between DMT, below 0.1, and JKR, above 5; {}", model);
}

const char* short_name(ValidityQuantity quantity) {
  using enum ValidityQuantity;
  static constexpr Phrase<ValidityQuantity> phrases[] = {
      {contact_radius, "contact radius over that of the sphere"},
      {pressure_modulus, "peak pressure over E*"},
      {pressure_yield, "peak pressure over that of first yield"},
      {tabor, "Tabor parameter"},
      {wave_transits, "contact time over a wave's transit"}};
  return phrase_for(phrases, quantity).words;
}

}  // namespace

std::string validity_sentence(const Validity& v) {
  using enum ValidityQuantity;
  static constexpr Phrase<ValidityQuantity> patterns[] = {
      {contact_radius,
       "the contact grows to {value:.2g} of the sphere's radius ({impact}); Hertz' theory holds up "
       "to about {limit:g}"},
      {pressure_modulus,
       "the peak pressure is {value:.2g} E* ({impact}); no solid withstands more than about "
       "{limit:g} E*"},
      {pressure_yield,
       "the peak pressure is {value:.2g} times the pressure of first yield, {yield}, {source} "
       "({impact}); above {limit:g} the contact yields, which the base model ignores"},
      {tabor, "the Tabor parameter is {value:.2g} ({diameter}): {tabor}"},
      {wave_transits,
       "a wave crosses the sphere {value:.2g} times in one contact ({impact}); below {limit:g} the "
       "contact is not quasi-static"}};
  return fmt::format(fmt::runtime(phrase_for(patterns, v.quantity).words),
                     fmt::arg("value", v.value), fmt::arg("limit", v.limit),
                     fmt::arg("impact", impact_words(v)),
                     fmt::arg("diameter", diameter_words(v.diameter)),
                     fmt::arg("yield", pressure_words(v.yield_pressure)),
                     fmt::arg("source", v.yield_stated ? "by the stated strength"
                                                       : "an estimate, 0.017 E of the softer body, "
                                                         "since no strength is stated"),
                     fmt::arg("tabor", tabor_words(v)));
}

std::vector<std::string> exceeded_limits(const std::vector<Validity>& validity,
                                         const std::vector<Dataset>& datasets) {
  std::vector<Validity> worst;  // one for each quantity
  for (const Validity& one : validity) {
    if (one.exceeded()) keep_worst(one, worst);
  }
  std::vector<std::string> sentences;
  for (const Validity& one : worst) {
    sentences.push_back(validity_sentence(one));
    if (datasets.size() < 2 || one.dataset >= datasets.size()) continue;
    sentences.back() =
        fmt::format("on {}, {}", short_name(datasets, one.dataset), sentences.back());
  }
  return sentences;
}

Table validity_table(const std::vector<Validity>& validity) {
  Table table;
  if (validity.empty()) return table;
  table.caption = "where the model holds:";
  table.columns = {{}, {"value"}, {"valid", "", true}};
  for (const Validity& one : validity) {
    table.rows.push_back({Sentence(short_name(one.quantity)), Number{one.value, significant(3)},
                          Sentence(fmt::format("{} {:g}{}", one.limit_is_least() ? "from" : "up to",
                                               one.limit, one.exceeded() ? ": outside" : ""))});
  }
  return table;
}

}  // namespace recoil
