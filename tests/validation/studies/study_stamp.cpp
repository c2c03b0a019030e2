#include "validation/studies/study_stamp.hpp"

namespace recoil {

std::vector<Block> stamp_blocks(const StudyStamp& stamp) {
  Sentence made = say("Made by {} ({}), from sources with the key {}.",
                      code("./run study " + stamp.study), code(stamp.command), code(stamp.key));
  return {Paragraph{made}};
}

}  // namespace recoil
