#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

namespace recoil {

class KeptRows;

struct DiagnosisOptions {
  /// Number of data sets, simulated with the base model, that calibrate the tests of the residuals
  /// and the gains of causes.
  int simulated = 399;
  /// A sequential test (Besag & Clifford 1991, Biometrika 78:301): after this many of them, the
  /// rest is not simulated if the p-value is above `clearly_above`. If the p-value of all were at
  /// `level`, that would happen once in ten million diagnoses (binomial).
  int first_simulated = 99;
  double clearly_above = 0.2;
  /// Level of the test for structure: the fraction of data sets in which a correct model whose
  /// losses have the allowed error is rejected, if the stated deviations are right. Without that
  /// error it is rejected less often.
  double level = 0.05;
  double chance = 0.05;  ///< a cause must gain more than chance gives the best candidate in all but
                         ///< this fraction of data sets
  /// Two causes whose criteria differ by less than this margin cannot be distinguished. For a false
  /// rival R and the true cause T, with delta^2 the misfit that R leaves, the difference of their
  /// deviances is about normal with mean delta^2 and standard deviation 2 delta. R is then ahead by
  /// c with a probability of at most Phi(-sqrt(c)), attained at delta^2 = c: 2.3 % at 4, for equal
  /// numbers of parameters. From a difference of 4 on, a model has "considerably less support"
  /// (Burnham & Anderson 2002, Model Selection and Multimodel Inference, section 2.6).
  double margin = 4.0;
  /// The same between pairs, which have more rivals (0.7 % each), and between a single cause and a
  /// pair.
  double margin_in_pairs = 6.0;
  std::uint64_t seed = 20260101;
  bool answer_alone = false;   ///< compute only the verdict with the named or listed causes
  bool single_causes = false;  ///< do not search for pairs of causes
  int threads = 0;             ///< 0: all cores. Results do not depend on it.
  /// Results of pieces of the work (`KeptPiece`) from an earlier run or other processes: those
  /// pieces are not run again, and new results are added. Null: nothing is kept.
  std::shared_ptr<KeptRows> kept;
  std::size_t first_piece = 0;  ///< first piece of the calibration for these data

  /// The number of pieces of the calibration of one diagnosis.
  std::size_t pieces() const { return static_cast<std::size_t>(simulated); }
};

}  // namespace recoil
