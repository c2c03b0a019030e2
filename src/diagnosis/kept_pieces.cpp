#include "diagnosis/kept_pieces.hpp"

#include <stdexcept>
#include <string>

namespace recoil {

std::size_t number_of(const DiagnosisOptions& options, KeptPiece kind, std::size_t k) {
  constexpr std::size_t kinds = 4;
  constexpr std::size_t of_each = std::size_t{1} << 32;
  return ((options.first_piece + 1) * kinds + static_cast<std::size_t>(kind)) * of_each + k;
}

Json json_of(const Refit& refit) {
  if (!refit.usable) return Json::array();
  return Json::array({row_json(refit.theta), row_json({refit.chi2}), row_json(refit.residuals),
                      row_json(refit.jacobian), refit.moving});
}

Refit refit_of(const Json& json, const Candidate& candidate, std::size_t points) {
  Refit refit;
  if (json.empty()) return refit;
  refit.usable = true;
  refit.theta = row_numbers(json.at(0));
  refit.chi2 = row_numbers(json.at(1)).at(0);
  refit.residuals = row_numbers(json.at(2));
  refit.jacobian = row_numbers(json.at(3));
  refit.moving = json.at(4).get<std::vector<bool>>();
  const std::size_t p = candidate.model.slots.size();
  if (refit.theta.size() != p || refit.moving.size() != p || refit.residuals.size() != points ||
      refit.jacobian.size() < points * p) {
    throw std::length_error("a refit of something else");
  }
  return refit;
}

void require_names(const Json& row, const std::vector<std::string>& names) {
  if (row.at(0).get<std::vector<std::string>>() != names) {
    throw std::invalid_argument("a row of something else");
  }
}

}  // namespace recoil
