#include "data/quantity.hpp"

#include <gtest/gtest.h>

namespace recoil {
namespace {

double length(const std::string& text) {
  return parse_quantity(text, Dimension::length, "um", "the length");
}

TEST(Quantity, HasAUnitOrTheUsualOne) {
  EXPECT_DOUBLE_EQ(length("20"), 20e-6);
  EXPECT_DOUBLE_EQ(length("20mm"), 20e-3);
  EXPECT_DOUBLE_EQ(length("8 um"), 8e-6);
  EXPECT_DOUBLE_EQ(length("100 cm"), 1.0);
  EXPECT_DOUBLE_EQ(length(" 1e2nm"), 1e-7);
  EXPECT_DOUBLE_EQ(parse_quantity("20degC", Dimension::temperature, "K", "T"), 293.15);
  EXPECT_DOUBLE_EQ(parse_quantity("200 GPa", Dimension::pressure, "Pa", "E"), 2e11);
  EXPECT_DOUBLE_EQ(parse_quantity("7.8 g/cm3", Dimension::density, "kg/m3", "density"), 7800.0);
}

TEST(Quantity, AMistakeNamesIt) {
  const auto complaint = [](const std::string& text) -> std::string {
    try {
      length(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("wide"), "the length 'wide' is not a number; write for example 4.9um");
  EXPECT_NE(complaint("3 s").find("the length in 's' (that is the unit of a time)"),
            std::string::npos)
      << complaint("3 s");
  EXPECT_NE(complaint("3 miles").find("unknown unit 'miles' of the length"), std::string::npos);
  EXPECT_NE(complaint("nan"), "");
}

}  // namespace
}  // namespace recoil
