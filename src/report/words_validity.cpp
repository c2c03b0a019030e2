#include "report/words_validity.hpp"

#include <fmt/format.h>

#include "core/units.hpp"
#include "report/format.hpp"

namespace recoil {
namespace {

constexpr double dmt_limit = 0.1;  // of the Tabor parameter

std::string impact_words(const Validity& v) {
  return fmt::format("{:.3g} m/s, {}", v.velocity, diameter_words(v.diameter));
}

std::string pressure_words(double pressure) {
  return pressure < units::GPa ? fmt::format("{:.2g} MPa", pressure / 1e6)
                               : fmt::format("{:.2g} GPa", pressure / units::GPa);
}

std::string tabor_words(const Validity& v) {
  const char* const model = "the model has the equilibrium of JKR";
  if (!v.passed()) return "adhesion acts inside the contact (JKR), as the model has it";
  if (v.value < dmt_limit) return fmt::format("adhesion acts around the contact (DMT); {}", model);
  return fmt::format("between DMT, below 0.1, and JKR, above 5; {}", model);
}

const char* short_name(ValidityQuantity quantity) {
  switch (quantity) {
    case ValidityQuantity::contact_radius:
      return "contact radius over that of the sphere";
    case ValidityQuantity::pressure_modulus:
      return "peak pressure over E*";
    case ValidityQuantity::pressure_yield:
      return "peak pressure over a plausible yield pressure";
    case ValidityQuantity::tabor:
      return "Tabor parameter";
    case ValidityQuantity::wave_transits:
      return "contact time over a wave's transit";
  }
  return "";
}

}  // namespace

std::string validity_sentence(const Validity& v) {
  switch (v.quantity) {
    case ValidityQuantity::contact_radius:
      return fmt::format(
          "the contact grows to {:.2g} of the sphere's radius ({}); Hertz' theory is good to about "
          "{:g}",
          v.value, impact_words(v), v.limit);
    case ValidityQuantity::pressure_modulus:
      return fmt::format(
          "the peak pressure is {:.2g} E* ({}); no solid bears more than about {:g} E*", v.value,
          impact_words(v), v.limit);
    case ValidityQuantity::pressure_yield:
      return fmt::format(
          "the peak pressure is {:.2g} times a plausible yield pressure of {}, 0.03 E of the "
          "softer body ({}); above {:g} the contact yields, which the base "
          "model leaves out",
          v.value, pressure_words(v.yield_pressure), impact_words(v), v.limit);
    case ValidityQuantity::tabor:
      return fmt::format("the Tabor parameter is {:.2g} ({}): {}", v.value,
                         diameter_words(v.diameter), tabor_words(v));
    case ValidityQuantity::wave_transits:
      return fmt::format(
          "a wave crosses the sphere {:.2g} times in one contact ({}); below {:g} the contact is "
          "not quasi-static",
          v.value, impact_words(v), v.limit);
  }
  return "";
}

std::vector<std::string> passed_limits(const std::vector<Validity>& validity,
                                       const std::vector<Dataset>& datasets) {
  std::vector<std::string> sentences;
  for (const Validity& one : validity) {
    if (!one.passed()) continue;
    const std::string sentence = validity_sentence(one);
    sentences.push_back(datasets.size() > 1 && one.dataset < datasets.size()
                            ? fmt::format("on {} {}", datasets[one.dataset].id, sentence)
                            : sentence);
  }
  return sentences;
}

Table validity_table(const std::vector<Validity>& validity) {
  Table table;
  if (validity.empty()) return table;
  table.caption = "where the model holds:";
  table.columns = {{}, {"value"}, {"good", "", true}};
  for (const Validity& one : validity) {
    table.rows.push_back({Sentence(short_name(one.quantity)), Number{one.value, significant(3)},
                          Sentence(fmt::format("{} {:g}{}", one.limit_is_least() ? "from" : "up to",
                                               one.limit, one.passed() ? ": outside" : ""))});
  }
  return table;
}

}  // namespace recoil
