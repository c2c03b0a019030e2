#include "predict/published_captures.hpp"

#include <algorithm>
#include <cctype>

#include "core/units.hpp"

namespace recoil {
namespace {

using units::um;

constexpr const char* energies = "Energies 2013, 6(8), 4288, doi 10.3390/en6084288";
constexpr const char* arffman = "Arffman et al. (2015), J. Aerosol Sci. 86, 32-43";
constexpr const char* pasha = "quoted in Pasha et al. (2014), doi 10.1007/s10035-013-0476-y";
constexpr const char* li = "Li, Dunn & Brach (1999), section 4.2";

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// Does `name` speak of `material`, in whole words?
bool names(const std::string& name, const std::string& material) {
  const std::string text = lower_case(name);
  const std::string word = lower_case(material);
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool from_start = at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0;
    const bool to_end =
        end == text.size() || std::isalnum(static_cast<unsigned char>(text[end])) == 0;
    if (from_start && to_end) return true;
  }
  return false;
}

}  // namespace

const std::vector<PublishedCapture>& published_captures() {
  // The composition of the fly ash changes with its size, so its three values are no size law.
  static const std::vector<PublishedCapture> all = {
      {"fly ash", "planar surface", 88 * um, 1.92, true, "measured", energies},
      {"fly ash", "planar surface", 96 * um, 1.25, true, "measured", energies},
      {"fly ash", "planar surface", 104 * um, 0.69, true, "measured", energies},
      {"silver", "aluminium", 0.02 * um, 14.0, true, "measured", arffman},
      {"silver", "aluminium", 1.0 * um, 0.022, true, "measured", arffman},
      {"CO2 ice", "CO2 ice", 100 * um, 0.04, true, "measured at 80 K, size approximate",
       "Musiolik et al. (2016), arXiv:1601.04854"},
      {"ammonium fluorescein", "silicon", 4.9 * um, 0.57, false, "JKR", pasha},
      {"ammonium fluorescein", "silicon", 4.9 * um, 1.6, false, "elastoplastic simulation", pasha},
      {"stainless steel", "silicon", 20 * um, 0.9, false, "the paper's simulation", li},
      {"stainless steel", "silicon", 110 * um, 0.1, false, "the paper's simulation", li},
  };
  return all;
}

std::vector<PublishedCapture> published_captures_for(const Material& particle,
                                                     const Material& surface) {
  std::vector<PublishedCapture> found;
  for (const PublishedCapture& one : published_captures()) {
    if (names(particle.name, one.particle) && names(surface.name, one.surface)) {
      found.push_back(one);
    }
  }
  return found;
}

std::optional<PublishedYield> published_yield_pressure(const Material& particle) {
  if (names(particle.name, "ammonium fluorescein")) return PublishedYield{35.3e6, pasha};
  return std::nullopt;
}

}  // namespace recoil
