#pragma once

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "diagnosis/search.hpp"
#include "support/synthetic.hpp"

namespace recoil {

/// A search for causes in the synthetic dataset, by one who takes all laws for exact.
class SearchWithExactLaws : public testing::Test {
 protected:
  SearchWithExactLaws() {
    fitted_ = fit(make_model(spec_, data_), gather(data_, spec_.noise));
    base_.emplace(search_base(spec_, data_, fitted_, options_));
  }

  static FitSpec with_exact_laws() {
    FitSpec spec = synthetic::spec();
    spec.law_error = 0.0;
    return spec;
  }

  const FitSpec spec_ = with_exact_laws();
  const DiagnosisOptions options_;
  const std::vector<Dataset> data_ = {synthetic::dataset({})};
  FitResult fitted_;
  std::optional<SearchBase> base_;
};

}  // namespace recoil
