#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <charconv>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "data/dataset.hpp"
#ifndef RECOIL_READERS
#include "report/dataset_report.hpp"
#endif
#include "support/dataset_folder.hpp"

namespace recoil {
namespace {

/// A point as it is written: numbers in the units of the schema, SI for all but the series.
struct Row {
  std::string series;
  double diameter;
  double velocity;
  double restitution;
  std::optional<double> sd;
  int events;
  int captured;
};

/// The shortest decimal text that reads back as `value`.
std::string shortest(double value) {
  char text[64];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

std::string quoted(const std::string& text) {
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + "\"";
}

rc::Gen<double> between(double lower, double upper) {
  return rc::gen::map(rc::gen::inRange<std::int64_t>(0, 1LL << 53), [=](std::int64_t n) {
    const double u = static_cast<double>(n) / static_cast<double>(1LL << 53);
    return lower * std::pow(upper / lower, u);
  });
}

rc::Gen<Row> any_row() {
  return rc::gen::exec([] {
    Row row;
    row.series = *rc::gen::nonEmpty(
        rc::gen::container<std::string>(rc::gen::elementOf(std::string("abcXYZ 019.,;-_/'\"()%"))));
    row.diameter = *between(1e-9, 1.0);
    row.velocity = *between(1e-6, 9999.0);
    row.events = *rc::gen::inRange(1, 1000);
    row.captured = *rc::gen::inRange(0, row.events + 1);
    row.restitution = row.captured == row.events ? 0.0 : *between(1e-9, 1.2);
    if (*rc::gen::arbitrary<bool>()) row.sd = *between(0.03, 1.0);
    return row;
  });
}

/// Made when it is asked for: the example stands in another source.
std::string si_package() {
  return support::changed(
      support::changed(support::changed(example::package, R"("unit": "um")", R"("unit": "m")"),
                       R"("restitution_sd", "type": "number", "unit": "%")",
                       R"("restitution_sd", "type": "number", "unit": "1")"),
      R"({ "name": "velocity_sd", "type": "number", "unit": "cm/s" },)", "");
}

RC_GTEST_PROP(Property, ATableThatIsWrittenReadsBackExactly, ()) {
  const auto rows = *rc::gen::nonEmpty(rc::gen::container<std::vector<Row>>(any_row()));
  std::string csv =
      "series,diameter,incident_velocity,restitution,restitution_sd,events,captured\n";
  for (const Row& row : rows) {
    csv += quoted(row.series) + "," + shortest(row.diameter) + "," + shortest(row.velocity) + "," +
           shortest(row.restitution) + "," + (row.sd ? shortest(*row.sd) : "") + "," +
           std::to_string(row.events) + "," + std::to_string(row.captured) + "\n";
  }
  const Dataset dataset = parse_dataset(si_package(), csv, "folder");
  RC_ASSERT(dataset.points.size() == rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ImpactPoint& point = dataset.points[i];
    RC_ASSERT(dataset.series.at(point.series) == rows[i].series);
    RC_ASSERT(point.diameter == rows[i].diameter);
    RC_ASSERT(point.incident_velocity == rows[i].velocity);
    RC_ASSERT(point.restitution == rows[i].restitution);
    RC_ASSERT(point.restitution_sd == rows[i].sd);
    RC_ASSERT(point.events == rows[i].events);
    RC_ASSERT(point.captured == rows[i].captured);
    RC_ASSERT(point.line == static_cast<int>(i) + 2);
  }
}

/// What every dataset that got through the door keeps to.
void assert_sound(const Dataset& dataset) {
  RC_ASSERT(!dataset.points.empty());
  for (const ImpactPoint& point : dataset.points) {
    RC_ASSERT(point.series < dataset.series.size());
    RC_ASSERT(std::isfinite(point.diameter) && point.diameter > 0.0);
    RC_ASSERT(std::isfinite(point.incident_velocity) && point.incident_velocity > 0.0);
    RC_ASSERT(point.restitution >= 0.0 && point.restitution <= 1.2);
    RC_ASSERT(point.captured >= 0 && point.captured <= point.events);
    RC_ASSERT((!point.restitution_sd || *point.restitution_sd > 0.0));  // short-circuits
  }
#ifndef RECOIL_READERS
  RC_ASSERT(!dataset_text(dataset).empty());
#endif
}

/// Some bytes of `text` replaced, removed or put in.
std::string mutated(std::string text) {
  const int count = *rc::gen::inRange(1, 4);
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<std::size_t>(*rc::gen::inRange<std::size_t>(0, text.size()));
    const char byte = *rc::gen::oneOf(rc::gen::arbitrary<char>(),
                                      rc::gen::elementOf(std::string("0123456789.,-\"{}[]:e\n ")));
    switch (*rc::gen::inRange(0, 3)) {
      case 0:
        text[at] = byte;
        break;
      case 1:
        text.erase(at, 1);
        break;
      default:
        text.insert(at, 1, byte);
    }
  }
  return text;
}

void loads_or_complains(const std::string& package, const std::string& points) {
  try {
    assert_sound(parse_dataset(package, points, "folder"));
  } catch (const InputError& error) {
    const std::string text = error.what();
    RC_ASSERT(text.find('\n') == std::string::npos);
    RC_ASSERT(text.starts_with("folder/"));
    RC_ASSERT(error.where().line >= 1);
    RC_ASSERT(error.where().column >= 1);
  }
}

RC_GTEST_PROP(Property, DamagedPointsLoadOrComplain, ()) {
  loads_or_complains(example::package, mutated(example::points));
}

RC_GTEST_PROP(Property, ADamagedPackageLoadsOrComplains, ()) {
  loads_or_complains(mutated(example::package), example::points);
}

TEST(Property, EverySingleByteMayBeMissing) {
  for (std::size_t i = 0; i < example::package.size(); ++i) {
    std::string text = example::package;
    text.erase(i, 1);
    loads_or_complains(text, example::points);
    loads_or_complains(example::package.substr(0, i), example::points);
  }
  for (std::size_t i = 0; i < example::points.size(); ++i) {
    std::string text = example::points;
    text.erase(i, 1);
    loads_or_complains(example::package, text);
    loads_or_complains(example::package, example::points.substr(0, i));
  }
}

}  // namespace
}  // namespace recoil
