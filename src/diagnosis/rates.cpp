#include "diagnosis/rates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/search.hpp"
#include "estimate/predictor.hpp"

namespace recoil {
namespace {

/// The first index of these draws, separate from the draws that calibrate a diagnosis.
constexpr std::uint64_t first_draw = std::uint64_t{1} << 32;

/// e^2 of every point if `cause` has the fraction `strength` of its estimated effect.
std::vector<double> squares_at(const CandidateResult& cause, const Observations& data,
                               double strength) {
  const ImpactModel& model = cause.candidate.model;
  const std::vector<double>& theta = cause.refit.theta;
  std::vector<double> without = theta;
  for (const Mechanism* mechanism : model.chain) {
    if (cause.candidate.adds(std::string(mechanism->info.id))) {
      without = without_mechanism(model, std::move(without), *mechanism);
    }
  }
  const std::vector<Prediction> acted = predict(model, theta, data.conditions(), false);
  const std::vector<Prediction> plain = predict(model, without, data.conditions(), false);
  std::vector<double> squares;
  for (std::size_t i = 0; i < acted.size(); ++i) {
    const double before = plain[i].restitution_squared;
    squares.push_back(before + strength * (acted[i].restitution_squared - before));
  }
  return squares;
}

/// `datasets` with the readings of `sample`, whose points are in the same order.
std::vector<Dataset> with_readings(std::vector<Dataset> datasets, const Observations& sample) {
  std::size_t next = 0;
  for (Dataset& dataset : datasets) {
    for (ImpactPoint& point : dataset.points) {
      const Observation& drawn = sample.points[next++];
      point.captured = drawn.censored ? point.events : drawn.captured;
      point.restitution = drawn.censored ? 0.0 : drawn.restitution;
    }
  }
  return datasets;
}

DiagnosisOptions of_one_data_set(DiagnosisOptions options) {
  options.kept.reset();
  options.answer_alone = true;
  options.threads = 1;
  options.first_piece = 0;
  return options;
}

bool contains(const std::vector<std::string>& ids, const std::string& id) {
  return std::ranges::find(ids, id) != ids.end();
}

}  // namespace

DesignRates::DesignRates(const Diagnosis& diagnosis, int datasets)
    : diagnosis_(diagnosis),
      options_(of_one_data_set(diagnosis.options)),
      base_(std::make_unique<const SearchBase>(
          search_base(diagnosis.spec, diagnosis.datasets, diagnosis.base, options_))),
      datasets_(static_cast<std::size_t>(datasets)) {
  for (const CandidateResult& c : diagnosis.candidates) {
    const std::string& id = c.candidate.added.front();
    if (!contains(diagnosis.named(), id) && !contains(diagnosis.rivals(), id)) continue;
    for (const double strength : {1.0, 0.5}) {
      truths_.push_back({id, strength, squares_at(c, diagnosis.base.data, strength)});
    }
  }
  truths_.push_back({"", 0.0, diagnosis.base.prediction_squared});
}

DesignRates::~DesignRates() = default;

std::size_t DesignRates::pieces() const { return truths_.size() * datasets_; }

std::vector<double> DesignRates::run(std::size_t piece) const {
  const Truth& truth = truths_[piece / datasets_];
  const std::vector<Dataset> datasets = with_readings(
      diagnosis_.datasets, simulate_points(*base_, truth.squares, 0.0, first_draw + piece).data);
  try {
    const Diagnosis found = diagnose(diagnosis_.spec, datasets, options_);
    const bool alone = found.named() == std::vector<std::string>{truth.id};
    const bool listed = contains(found.named(), truth.id) || contains(found.rivals(), truth.id);
    const bool seen = found.verdict() != Verdict::adequate;
    return {seen ? 1.0 : 0.0, alone ? 1.0 : 0.0, listed && !alone ? 1.0 : 0.0,
            found.answer_if<CauseNamed>() && !listed ? 1.0 : 0.0};
  } catch (const ComputationError&) {  // a failed fit gives no answer
    return {0.0, 0.0, 0.0, 0.0};
  }
}

OwnDesign DesignRates::count(const std::vector<std::vector<double>>& rows) const {
  OwnDesign design;
  for (std::size_t k = 0; k < truths_.size(); ++k) {
    std::array<int, 4> sums{};
    for (std::size_t i = k * datasets_; i < (k + 1) * datasets_; ++i) {
      for (std::size_t q = 0; q < sums.size(); ++q) sums[q] += rows[i].at(q) > 0.0 ? 1 : 0;
    }
    if (truths_[k].id.empty()) {
      design.datasets = static_cast<int>(datasets_);
      design.alarms = sums[0];
    } else {
      design.detection.push_back({truths_[k].id, truths_[k].strength, static_cast<int>(datasets_),
                                  sums[1], sums[2], sums[3]});
    }
  }
  return design;
}

std::string DesignRates::digits() const {
  std::string digits;
  for (const Truth& truth : truths_) {
    digits += truth.id;
    for (const double square : truth.squares) digits += fmt::format("{:a}|", square);
  }
  return digits;
}

}  // namespace recoil
