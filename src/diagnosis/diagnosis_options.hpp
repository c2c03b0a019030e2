#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace recoil {

class KeptRows;

struct DiagnosisOptions {
  /// Data sets of the base model that calibrate the tests of the residuals and the gains of causes.
  int simulated = 399;
  /// A correct model whose losses are wrong by the error that they are allowed is accused in this
  /// part of all data, if the stated deviations are right; one without that error in less.
  double level = 0.05;
  double chance = 0.05;  ///< what a cause gains, chance gives in no more than this part
  /// Two causes whose criteria differ by less than this margin cannot be told from each other. For
  /// a false rival R and the truth T, with delta^2 the misfit that R would leave, the difference of
  /// their deviances is about normal with mean delta^2 and standard deviation 2 delta, so that R
  /// leads by c with a probability of at most Phi(-sqrt(c)), attained at delta^2 = c: 2.3 % at 4,
  /// for rivals of as many parameters. From a difference of 4 on, a model has "considerably less
  /// support" (Burnham & Anderson 2002, Model Selection and Multimodel Inference, section 2.6).
  double margin = 4.0;
  /// The same for two at once, where more rivals crowd: 0.7 % each; and of a single cause from two
  /// others.
  double margin_in_pairs = 6.0;
  std::uint64_t seed = 20260101;
  bool answer_alone = false;  ///< only the verdict, with what is named or listed
  int threads = 0;            ///< 0: all cores. No digit depends on it.
  /// Results of pieces of the work (`KeptPiece`) from an earlier run or other processes: those
  /// pieces are not run again, and new results are added. Null: nothing is kept.
  std::shared_ptr<KeptRows> kept;
  std::size_t first_piece = 0;  ///< of the calibration, for the data that are diagnosed

  /// The number of pieces of the calibration for one set of data.
  std::size_t pieces() const { return static_cast<std::size_t>(simulated); }
};

}  // namespace recoil
