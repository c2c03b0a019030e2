#include "report/words_dataset.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "support/dataset_folder.hpp"

namespace recoil {
namespace {

std::string described(const std::string& package, const std::string& points = example::points) {
  return describe(parse_dataset(package, points, "folder"));
}

TEST(Describe, SaysWhatWasReadWithUnits) {
  const std::string text = described(example::package);
  for (const char* word :
       {"example-quartz", "Spheres on quartz", "measured", "polystyrene, density 1050 kg/m3",
        "E 2.56 GPa, nu 0.35", "quartz, E 73 GPa", "Gilman", "diameter [um]", "V [m/s]", "e [1]",
        "restitution_sd [%]", "velocity_sd [cm/s]", "4 in 2 series", "1.25 to 35", "0.71 to 0.95",
        "large, coated", "A paper, https://example.org/paper", "sha256"}) {
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is missing in\n" << text;
  }
  EXPECT_EQ(text.find("warnings"), std::string::npos) << text;
}

TEST(Describe, ShowsOverridesAndWarnings) {
  const std::string text =
      described(support::changed(example::package, "\"provenance\"",
                                 "\"stiffness_K\": 3.745e9, \"adhesion_energy\": 0.235,\n"
                                 "\"adhesion_force_f0\": 5.74, \"reference_diameter\": 1.28e-6,"
                                 "\"provenance\""),
                support::changed(example::points, "0.912", "1.1"));
  for (const char* word : {"K 3.745 GPa", "adhesion energy 0.235 J/m2", "f0 5.74 N/m",
                           "reference diameter 1.28 um", "warnings", "above 1"}) {
    EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' is missing in\n" << text;
  }
}

TEST(Describe, ColumnsStandBelowTheirHeads) {
  const std::string text =
      described(example::package, support::changed(example::points, "large", "gro\xC3\x9F"));
  std::istringstream lines(text);
  std::vector<std::size_t> places;
  for (std::string line; std::getline(lines, line);) {
    std::string characters;  // one byte for each character
    for (const char c : line) {
      if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) characters += c;
    }
    if (const auto at = characters.find("diameter [um]  "); at != std::string::npos) {
      places.push_back(at);
    } else if (const auto value = characters.find("4.9 "); value != std::string::npos) {
      places.push_back(value);
    }
  }
  ASSERT_EQ(places.size(), 2U) << text;
  EXPECT_EQ(places[0], places[1]) << text;
}

TEST(Provenance, TheWordAndItsSentenceStandInTheDescription) {
  for (const Provenance provenance : {Provenance::measured, Provenance::digitised,
                                      Provenance::reconstruction, Provenance::synthetic}) {
    std::string text =
        described(support::changed(example::package, "\"measured\"",
                                   std::string("\"").append(to_string(provenance)).append("\"")));
    EXPECT_NE(text.find(to_string(provenance)), std::string::npos);
    // The sentence may be broken into lines: compare it without blanks.
    std::string sentence = provenance_sentence(provenance);
    EXPECT_FALSE(sentence.empty());
    EXPECT_EQ(std::count(sentence.begin(), sentence.end(), '.'), 1) << "one sentence";
    for (std::string* s : {&text, &sentence}) {
      s->erase(std::remove_if(s->begin(), s->end(), [](char c) { return c == ' ' || c == '\n'; }),
               s->end());
    }
    EXPECT_NE(text.find(sentence), std::string::npos) << text;
  }
}

TEST(Provenance, AReconstructionSaysThatNothingWasMeasured) {
  const std::string sentence = provenance_sentence(Provenance::reconstruction);
  for (const char* word :
       {"reconstruction", "recipe", "published facts", "not one of them was measured",
        "what the method does", "not what the experiment found"}) {
    EXPECT_NE(sentence.find(word), std::string::npos) << word;
  }
}

}  // namespace
}  // namespace recoil
