#include "support/mistake.hpp"

namespace support {

void expect_mistake(const std::optional<recoil::InputError>& error, const Mistake& mistake,
                    const std::string& folder) {
  if (!error) {
    ADD_FAILURE() << "no error";
    return;
  }
  std::string line = error->what();
  if (!folder.empty() && line.starts_with(folder)) line.erase(0, folder.size());
  EXPECT_TRUE(line.starts_with(mistake.begin)) << line << "\nshould begin " << mistake.begin;
  EXPECT_NE((error->problem() + " " + error->why()).find(mistake.word), std::string::npos) << line;
  EXPECT_NE(error->suggestion().find(mistake.hint), std::string::npos) << line;
  EXPECT_FALSE(error->problem().empty()) << line;
  EXPECT_FALSE(error->suggestion().empty()) << line;
  EXPECT_EQ(line.find_first_of("\n\r\t"), std::string::npos) << line;
  EXPECT_LT(line.size(), 300U) << line;
}

}  // namespace support
