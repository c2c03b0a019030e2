#pragma once

#include <string>
#include <vector>

#include "core/names.hpp"
#include "document/document.hpp"
#include "experiment/pairing.hpp"
#include "validation/studies/study.hpp"

namespace recoil {

enum class PairingTable { crowding, number, instruments };
constexpr auto names_of_values(PairingTable) {
  return name_list("crowding", "number", "instruments");
}

/// The pairing of one simulated stream beside its truth. Shares in [0, 1], lengths in m.
struct PairingRow {
  PairingTable table = PairingTable::crowding;
  std::string label;         ///< what differs from the usual stream
  double rate = 0.0;         ///< spheres per second
  std::size_t events = 0;    ///< rows of the file that can be read
  std::size_t possible = 0;  ///< first impacts of which both passages are among them
  std::size_t reported = 0;  ///< pairs
  double efficiency = 0.0;
  double purity = 0.0;            ///< both passages of one impact of one sphere
  double first_purity = 0.0;      ///< and not of a second impact that was not recognised
  double estimated_purity = 0.0;  ///< as `recoil pair` says itself
  bool returns_usable = false;    ///< later impacts were recognised
  double height = 0.0;
  double height_sd = 0.0;
  OrAbsent<double> seconds;  ///< reading and pairing, on one core of some machine
  RECOIL_FIELDS(table, label, rate, events, possible, reported, efficiency, purity, first_purity,
                estimated_purity, returns_usable, height, height_sd, seconds)
};

struct PairingStudy {
  StudyStamp stamp;
  std::vector<PairingRow> rows;
  RECOIL_FIELDS(rows)
};

/// Streams against crowding, against the number of spheres, and with worse instruments.
PairingStudy study_pairing();

Document page_of(const PairingStudy& study);

}  // namespace recoil
