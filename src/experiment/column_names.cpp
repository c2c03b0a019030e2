#include "experiment/column_names.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/numbers.hpp"

namespace recoil {
namespace {

struct OtherName {
  std::string_view quantity;
  std::string_view name;  ///< as `plain_word` writes it
};

/// Names in tables of others, also of the passages of `recoil pair`. Those of instruments: AT and
/// LDA1 to LDA4 are in the text files of Dantec's BSA Flow Software (first line DXEX), those with
/// Ch. in TSI's FlowSizer.
constexpr OtherName other_names[] = {
    {"incident_velocity", "v"},
    {"incident_velocity", "vi"},
    {"incident_velocity", "vin"},
    {"incident_velocity", "incidentspeed"},
    {"incident_velocity", "incomingvelocity"},
    {"incident_velocity", "impactvelocity"},
    {"incident_velocity", "impactspeed"},
    {"incident_velocity", "velocityin"},
    {"incident_velocity", "speedin"},
    {"incident_velocity", "vbefore"},
    {"incident_velocity", "velocitybefore"},
    {"incident_velocity", "speedbefore"},
    {"incident_velocity", "velocitybeforeimpact"},
    {"incident_velocity", "speedbeforeimpact"},
    {"rebound_velocity", "vr"},
    {"rebound_velocity", "vout"},
    {"rebound_velocity", "reboundspeed"},
    {"rebound_velocity", "velocityout"},
    {"rebound_velocity", "speedout"},
    {"rebound_velocity", "vafter"},
    {"rebound_velocity", "velocityafter"},
    {"rebound_velocity", "speedafter"},
    {"rebound_velocity", "velocityafterimpact"},
    {"rebound_velocity", "speedafterimpact"},
    {"restitution", "e"},
    {"restitution", "cor"},
    {"restitution", "coefficientofrestitution"},
    {"restitution", "restitutioncoefficient"},
    {"diameter", "d"},
    {"diameter", "dp"},
    {"diameter", "particlediameter"},
    {"diameter", "spherediameter"},
    {"velocity_sd", "vsd"},
    {"velocity_sd", "incidentvelocitysd"},
    {"restitution_sd", "esd"},
    {"diameter_sd", "dsd"},
    {"incidence_angle", "angle"},
    {"incidence_angle", "incidentangle"},
    {"incidence_angle", "angleofincidence"},
    {"drop_height", "drop"},
    {"drop_height", "heightofdrop"},
    {"rebound_height", "rebound"},
    {"rebound_height", "heightofrebound"},
    {"rebound_height", "bounceheight"},
    {"time", "at"},
    {"time", "arrivaltime"},
    {"time", "timech.1"},
    {"velocity", "v"},
    {"velocity", "lda1"},
    {"velocity", "lda2"},
    {"velocity", "lda3"},
    {"velocity", "lda4"},
    {"velocity", "velocitych.1"},
    {"velocity", "velocitych.2"},
    {"velocity", "velocitych.3"},
};

std::size_t begin_of_unit(std::string_view header) {
  return std::min(header.find_last_of("[("), header.size());
}

}  // namespace

std::string unit_in_brackets(std::string_view header) {
  const std::size_t open = header.find_last_of("[(");
  const std::size_t close = header.find_last_of("])");
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return "";
  return std::string(trimmed(header.substr(open + 1, close - open - 1)));
}

std::vector<std::size_t> columns_of(const std::string& quantity, Dimension dimension,
                                    const std::vector<std::string>& headers,
                                    const std::vector<std::string>& units) {
  const std::string plain = plain_word(quantity);
  std::vector<std::size_t> own;
  std::vector<std::size_t> with_unit;
  std::vector<std::size_t> other;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const std::string& header = headers[i];
    const std::string word = plain_word(std::string_view(header).substr(0, begin_of_unit(header)));
    if (header == quantity) {
      own.push_back(i);
    } else if (word == plain || header.substr(0, header.find_first_of(" [(")) == quantity) {
      with_unit.push_back(i);
    } else if (std::ranges::any_of(other_names, [&](const OtherName& known) {
                 return known.name == word && known.quantity == quantity;
               })) {
      std::string unit = unit_in_brackets(header);
      if (unit.empty() && i < units.size()) unit = units[i];
      constexpr std::size_t shortest = 4;
      const bool stated = unit_factor(dimension, unit).has_value();
      const bool certain = word.size() >= shortest && unit.empty();
      if (stated || certain || (unit.empty() && dimension == Dimension::ratio)) other.push_back(i);
    }
  }
  return !own.empty() ? own : !with_unit.empty() ? with_unit : other;
}

}  // namespace recoil
