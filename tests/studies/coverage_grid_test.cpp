#include "validation/studies/coverage_grid.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"

namespace recoil {
namespace {

TEST(CoverageGrid, DesignsAreNamedByTheirWords) {
  EXPECT_EQ(designs_named({}).size(), coverage_grid().size());
  EXPECT_EQ(designs_named({"n20", "stated"}).size(), 12U);
  EXPECT_EQ(designs_named({"10 %", "captures", "estimated"}).size(), 6U);
  EXPECT_EQ(designs_named({"n10 equal stated f0-fixed"}).size(), 2U);  // with and without captures
  try {
    designs_named({"n12", "stated"});
    FAIL() << "there are no 12 points in the grid";
  } catch (const InputError& e) {
    const std::string words = e.what();
    for (const char* known : {"'n12'", "n10", "n60", "near-capture", "f0-free", "captures"}) {
      EXPECT_NE(words.find(known), std::string::npos) << words;
    }
  }
  EXPECT_THROW(designs_named({"n10", "n20"}), InputError);
}

}  // namespace
}  // namespace recoil
