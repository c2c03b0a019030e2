#include "validation/studies/pairing_score.hpp"

#include <utility>
#include <vector>

namespace stream {
namespace {

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 1.0 : static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

double Score::efficiency() const { return share(found, possible); }
double Score::purity() const { return share(right, reported); }
double Score::first_purity() const { return share(right_first, reported); }

Score score(const Stream& stream, const recoil::PassageTable& table,
            const recoil::PairingResult& result) {
  Score score;
  std::vector<std::pair<bool, bool>> both;
  for (const Row& row : stream.rows) {
    if (!row.usable || row.impact != 1) continue;
    if (both.size() <= row.sphere) both.resize(row.sphere + 1);
    (row.down ? both[row.sphere].first : both[row.sphere].second) = true;
  }
  for (const auto& [down, up] : both) score.possible += down && up ? 1 : 0;
  for (const recoil::Impact& impact : result.impacts) {
    if (!impact.used) continue;
    ++score.reported;
    const Row& down = stream.rows[static_cast<std::size_t>(table.passages[impact.down].line)];
    const Row& up = stream.rows[static_cast<std::size_t>(table.passages[impact.up].line)];
    if (down.sphere != up.sphere || down.impact != up.impact) continue;
    ++score.right;
    if (down.impact != 1) continue;
    ++score.right_first;
    ++score.found;
  }
  return score;
}

recoil::PassageTable read(const Stream& stream) {
  recoil::PassageFormat format;
  format.units = {
      {"time", "s"}, {"velocity", "m/s"}, {"tangential_velocity", "m/s"}, {"diameter", "um"}};
  return recoil::parse_passages(stream.csv, "events.csv", "", format);
}

}  // namespace stream
