#include <fmt/format.h>

#include "core/units.hpp"
#include "report/format.hpp"
#include "report/html_page.hpp"
#include "report/html_tables.hpp"

namespace recoil {
namespace {

std::string stated(bool is_stated) { return is_stated ? "stated" : "derived"; }

std::string material_rows(const Dataset& dataset, const ContactProperties& contact) {
  HtmlTable table;
  table.caption = fmt::format("{}: the two bodies", dataset.id);
  table.head = {"", "particle", "surface"};
  const Material& p = dataset.system.particle;
  const Material& s = dataset.system.surface;
  table.rows = {{"material", escape_html(p.name), escape_html(s.name)},
                {"density [kg/m³]", number(p.density, 5), "–"},
                {"Young's modulus [GPa]", number(p.youngs_modulus / units::GPa),
                 number(s.youngs_modulus / units::GPa)},
                {"Poisson ratio", number(p.poisson_ratio), number(s.poisson_ratio)},
                {"surface energy [J/m²]",
                 fmt::format("{} ({})", number(contact.gamma_particle),
                             p.surface_energy ? "stated" : "Gilman"),
                 fmt::format("{} ({})", number(contact.gamma_surface),
                             s.surface_energy ? "stated" : "Gilman")}};
  return table_html(table);
}

std::string contact_rows(const Analysis& a, std::size_t k) {
  const Dataset& dataset = a.datasets[k];
  const ContactProperties& contact = a.fitted.model.contacts[k];
  const ImpactConditions conditions = reference_conditions(a, k, 1.0);
  const bool f0_free = a.fitted.model.slots[a.fitted.model.slot_f0[k]].free;
  HtmlTable table;
  table.caption = fmt::format("{}: the contact", dataset.id);
  table.head = {"", "used", "from"};
  table.words = {2};
  table.rows = {
      {"<i>K</i> [GPa]", number(contact.stiffness / units::GPa),
       stated(dataset.system.stiffness_K.has_value()) +
           fmt::format("; eq. 6 gives {}", number(contact.stiffness_derived / units::GPa))},
      {prose_html("W_A [J/m2]"), number(contact.adhesion_energy),
       dataset.system.adhesion_energy ? "stated"
                                      : "twice the geometric mean of the surface energies"},
      {prose_html("f0 [N/m]"), number(conditions.adhesion_force),
       (f0_free ? std::string("fitted") : stated(dataset.system.adhesion_force_f0.has_value())) +
           fmt::format("; eq. 12 gives {}", number(contact.adhesion_force_derived))},
      {"reference diameter [µm]", diameter_text(contact.reference_diameter),
       prose_html("f0 grows with the cube root of the radius from here")},
      {prose_html("a_eq [nm]"), number(contact.equilibrium_radius / units::nm), "eq. 10"},
      {prose_html("V_a [m/s]"), number(adhesion_velocity(conditions)),
       prose_html("the velocity at which adhesion and inertia balance")}};
  return table_html(table);
}

std::string sources_list(const std::vector<std::string>& sources) {
  if (sources.empty()) return "";
  std::string out = "<ul class=\"sources\">\n";
  for (const std::string& source : sources) {
    out += fmt::format("<li>{}</li>\n", escape_html(source));
  }
  return out + "</ul>\n";
}

}  // namespace

std::string inputs_tables(const Analysis& a) {
  std::string out;
  for (std::size_t k = 0; k < a.datasets.size(); ++k) {
    const Dataset& dataset = a.datasets[k];
    out += fmt::format("<h3>{}</h3>\n<p>{} {} points, {}. SHA-256 <code>{}</code></p>\n",
                       escape_html(dataset.id), escape_html(as_sentence(dataset.title)),
                       dataset.points.size(), escape_html(to_string(dataset.provenance)),
                       escape_html(dataset.sha256));
    out += sources_list(dataset.sources);
    out += material_rows(dataset, a.fitted.model.contacts[k]);
    out += contact_rows(a, k);
  }
  HtmlTable table;
  table.caption = "The fit";
  table.rows = {{"fit", escape_html(a.spec.id)},
                {"adhesion damping acts", a.fitted.model.phase == AdhesionDampingPhase::rebound
                                              ? "during rebound"
                                              : "during approach and rebound"},
                {"replicates", fmt::format("{}", a.uncertainty.options.replicates)},
                {"level of every interval", percent(a.uncertainty.options.level)},
                {"seed", fmt::format("{}", a.uncertainty.options.seed)},
                {"SHA-256 of the fit file", "<code>" + escape_html(a.spec.sha256) + "</code>"},
                {"recoil", escape_html(version())}};
  return out + table_html(table);
}

std::string glossary(const Analysis& a) {
  const std::pair<const char*, std::string> terms[] = {
      {"e",
       "Restitution: rebound velocity divided by incident velocity, both normal to the "
       "surface and at the surface. e = 1 loses nothing, e = 0 is capture."},
      {"C_H",
       "Damping of the Hertz force [s/m]: the contact pushes back harder while the sphere "
       "approaches than while it leaves."},
      {"C_A", "Damping of the adhesion force [s/m]; always takes energy out."},
      {"f0",
       "Adhesion force per length of the contact's edge [N/m]; the edge is a ring of length "
       "2 pi a, a the contact radius."},
      {"W_A", "Energy of adhesion per area of contact [J/m2]."},
      {"V_a", "The velocity at which adhesion and inertia balance; it sets the scale of capture."},
      {"V*", "Capture velocity: the largest incident velocity at which the sphere stays."},
      {"Two points",
       "The calibration of Li, Dunn & Brach (1999): the fastest point gives C_H, the slowest gives "
       "C_A, in turn until nothing changes."},
      {"Weighted residual", "Measured minus fitted, in standard deviations of the point."},
      {"Leverage", "How much a point pulls the fit towards itself, from 0 to 1."},
      {"Wald interval", "Estimate plus and minus a multiple of its standard error."},
      {"Profile interval",
       "All values for which the best fit with that value held is not "
       "significantly worse."},
      {"Percentile and BCa intervals",
       "Quantiles of the bootstrap estimates, plain, and corrected for bias and skewness."},
      {"Bootstrap", "The whole fit repeated on resampled data, to see how much the answer moves."},
      {"p-value",
       "The probability of a chi-square at least this large if the model and the "
       "stated deviations are right."}};
  std::string out = "<dl>\n";
  for (const auto& [term, meaning] : terms) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", prose_html(term), prose_html(meaning));
  }
  for (const auto& [label, sentence] : provenances(a.datasets)) {
    out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escape_html(label), prose_html(sentence));
  }
  return out + "</dl>\n";
}

}  // namespace recoil
