#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/json.hpp"
#include "core/names.hpp"
#include "validation/studies/baseline.hpp"
#include "validation/studies/ideal_judge.hpp"
#include "validation/synthetic/case.hpp"

namespace recoil::hidden {

/// What the diagnosis of one case answered, beside what is true.
struct Answered {
  CaseOrder order;
  bool reached = false;  ///< the wanted strength exists in nature; if not, nothing was asked
  double signal_to_noise = 0.0;  ///< of all effects together; the largest possible if not reached
  int status = 0;                ///< of the command
  std::string complaint;         ///< when that is not 0
  double seconds = 0.0;
  int rounds = 0;        ///< of further impacts that were taken
  long long events = 0;  ///< how many those were
  std::vector<FurtherImpacts> taken;
  std::string verdict;
  double p_value = 1.0;
  std::vector<std::string> named;
  std::vector<std::string> rivals;
  std::vector<std::string> resembles;  ///< what fits best and cannot be true
  std::vector<std::string> certain;    ///< of the rivals, those in every explanation
  std::string shared_cause;            ///< of which all rivals are laws
  bool hint = false;                   ///< no cause is named, but exact laws would leave structure
  std::vector<std::string> hinted;     ///< what that is most like
  std::vector<std::string> exact_named;  ///< what would then be named
  int odd = 0;                 ///< points that are misread by more than 5 standard deviations,
  int odd_found = 0;           ///< of these, set aside by the answer,
  int right = 0;               ///< the others,
  int accused = 0;             ///< and of them
  bool errors_told = false;    ///< errors that were not stated would do, and the answer says so
  OrAbsent<IdealJudge> ideal;  ///< of a visible effect
  OrAbsent<BaselineAnswers> baseline;  ///< where it was asked for
  RECOIL_FIELDS(order, reached, signal_to_noise, status, complaint, seconds, rounds, events, taken,
                verdict, p_value, named, rivals, resembles, certain, shared_cause, hint, hinted,
                exact_named, odd, odd_found, right, accused, errors_told, ideal, baseline)
};

/// How an answer stands to the truth.
enum class Mark {
  nothing,      ///< `adequate`
  unexplained,  ///< `unexplained`
  resembled,    ///< the same, but the shape of what is hidden is recognised
  named,        ///< all that is hidden is named, and nothing else
  part,         ///< one of several is named, and nothing else
  wrong,        ///< something is named that is not there
  inside,       ///< `not_separable`, and all that is hidden is among what is listed
  outside,      ///< `not_separable`, but what is hidden is not listed
  failed,       ///< the command gave no answer
};
constexpr auto names_of_values(Mark) {
  return name_list("adequate", "unexplained", "unexplained, shape recognised", "named",
                   "one of several named", "wrong cause named", "not separable, listed",
                   "not separable, not listed", "no answer");
}
Mark mark_of(const Answered& answered);

/// The answer that an earlier run left in `keep`.
std::optional<Answered> kept_answer(const CaseOrder& order, const std::filesystem::path& keep);

/// Makes the case in a scratch folder, lets `binary` diagnose it on one thread, and keeps the
/// answer in `keep` (when not empty), where the next run finds it.
/// @param baseline ask the plain methods, too, of visible effects and of every fourth data set with
/// nothing hidden
Answered ask(const CaseOrder& order, const std::filesystem::path& binary,
             const std::filesystem::path& keep, bool baseline = false);

}  // namespace recoil::hidden
