// Colour-blind readers can distinguish the colours of pictures, also on grey paper.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "plot/plot.hpp"

namespace recoil::plot {
namespace {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;

struct Sight {
  const char* name;
  Matrix matrix;  ///< on linear RGB
};

// Machado, Oliveira & Fernandes (2009), IEEE Trans. Vis. Comput. Graph. 15, 1291-1298, severity 1.
const std::array<Sight, 4> sights = {{{"normal", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
                                      {"protanopia",
                                       {{{0.152286, 1.052583, -0.204868},
                                         {0.114503, 0.786281, 0.099216},
                                         {-0.003882, -0.048116, 1.051998}}}},
                                      {"deuteranopia",
                                       {{{0.367322, 0.860646, -0.227968},
                                         {0.280085, 0.672501, 0.047413},
                                         {-0.011820, 0.042940, 0.968881}}}},
                                      {"tritanopia",
                                       {{{1.255528, -0.076749, -0.178779},
                                         {-0.078411, 0.930809, 0.147602},
                                         {0.004733, 0.691367, 0.303900}}}}}};

Vector product(const Matrix& m, const Vector& v) {
  Vector out = {};
  for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return out;
}

/// "#0072B2" without the gamma of sRGB (IEC 61966-2-1), from 0 to 1.
Vector linear(std::string_view colour) {
  Vector out = {};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(std::string(colour.substr(1 + 2 * i, 2)), nullptr, 16) / 255.0;
    out[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return out;
}

/// CIE 1976 L*, a*, b* under D65.
Vector lab(Vector rgb) {
  for (double& c : rgb) c = std::min(1.0, std::max(0.0, c));
  const Matrix to_xyz = {{{0.4124564, 0.3575761, 0.1804375},
                          {0.2126729, 0.7151522, 0.0721750},
                          {0.0193339, 0.1191920, 0.9503041}}};
  const Vector xyz = product(to_xyz, rgb);
  const auto f = [](double t) {
    return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16.0) / 116.0;
  };
  const double x = f(xyz[0] / 0.95047);
  const double y = f(xyz[1]);
  const double z = f(xyz[2] / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double distance(std::string_view a, std::string_view b, const Matrix& sight) {
  const Vector p = lab(product(sight, linear(a)));
  const Vector q = lab(product(sight, linear(b)));
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

/// WCAG 2: of two luminances, from 1 to 21.
double contrast_with_white(std::string_view colour) {
  const Vector c = linear(colour);
  return 1.05 / (0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2] + 0.05);
}

TEST(Colours, SimulationAndDistanceAreThePublishedOnes) {
  // Pure sRGB red has L*a*b* 53.24, 80.09, 67.20; greys look the same with every colour vision
  // deficiency.
  const Vector red = lab(linear("#ff0000"));
  EXPECT_NEAR(red[0], 53.24, 0.01);
  EXPECT_NEAR(red[1], 80.09, 0.01);
  EXPECT_NEAR(red[2], 67.20, 0.01);
  for (const Sight& sight : sights) {
    const Vector grey = product(sight.matrix, {0.4, 0.4, 0.4});
    for (const double c : grey) EXPECT_NEAR(c, 0.4, 1e-5) << sight.name;
  }
  EXPECT_LT(distance("#ff0000", "#7f6600", sights[1].matrix), 40.0) << "red and olive come close";
  EXPECT_GT(distance("#ff0000", "#7f6600", sights[0].matrix), 60.0);
}

TEST(Colours, OfMarkersStayApartInEverySight) {
  // 2.3 is just noticeable, side by side; small marks far from one another need several times that.
  constexpr double well_apart = 15.0;
  for (const Sight& sight : sights) {
    for (std::size_t a = 0; a < markers.size(); ++a) {
      for (std::size_t b = a + 1; b < markers.size(); ++b) {
        EXPECT_GT(distance(markers[a].colour, markers[b].colour, sight.matrix), well_apart)
            << sight.name << ": " << markers[a].colour << " and " << markers[b].colour;
      }
    }
  }
}

TEST(Colours, OfLinesBesideMarkersStayApartFromThem) {
  for (const Sight& sight : sights) {
    for (const Marker& marker : markers) {
      EXPECT_GT(distance(marker.colour, grey, sight.matrix), 12.0)
          << sight.name << ": " << marker.colour << " and grey";
      EXPECT_GT(distance(marker.colour, pale, sight.matrix), 15.0)
          << sight.name << ": " << marker.colour << " and pale";
    }
  }
}

TEST(Colours, ThatAreOneGreyOnPaperHaveMarksOfTheirOwn) {
  // Orange and sky have the same luminance: in grey only their marks differ.
  int alike = 0;
  for (std::size_t a = 0; a < markers.size(); ++a) {
    for (std::size_t b = a + 1; b < markers.size(); ++b) {
      const double lighter =
          std::abs(lab(linear(markers[a].colour))[0] - lab(linear(markers[b].colour))[0]);
      if (lighter > 10.0) continue;
      ++alike;
      EXPECT_NE(markers[a].mark, markers[b].mark);
    }
  }
  EXPECT_GT(alike, 0) << "otherwise the loop checks no pair";
}

TEST(Colours, StandOutFromThePaper) {
  for (const std::string_view words : {ink, grey}) {
    EXPECT_GE(contrast_with_white(words), 4.5) << words << " is written in";
  }
  for (const Marker& marker : markers) {
    EXPECT_GE(contrast_with_white(marker.colour), 2.2) << marker.colour;
  }
  EXPECT_NEAR(contrast_with_white("#767676"), 4.54, 0.01) << "as WCAG has it";
}

}  // namespace
}  // namespace recoil::plot
