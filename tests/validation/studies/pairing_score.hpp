#pragma once

#include <cstddef>

#include "experiment/pairing.hpp"
#include "experiment/passages.hpp"
#include "validation/synthetic/event_stream.hpp"

namespace stream {

/// The pairing compared with the truth.
struct Score {
  std::size_t possible = 0;     ///< first impacts of which both passages are in the file, unspoilt
  std::size_t found = 0;        ///< of these, reported and used
  std::size_t reported = 0;     ///< impacts that were reported and used
  std::size_t right = 0;        ///< of these, both passages belong to one impact of one sphere
  std::size_t right_first = 0;  ///< ... and it is the first of that sphere
  double efficiency() const;    ///< found / possible
  double purity() const;        ///< right / reported
  double first_purity() const;  ///< right_first / reported
};

Score score(const Stream& stream, const recoil::PassageTable& table,
            const recoil::PairingResult& result);

/// The events of the stream as `recoil pair` reads them.
recoil::PassageTable read(const Stream& stream);

}  // namespace stream
