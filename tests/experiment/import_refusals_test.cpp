// What import refuses, each with the words that say what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "import_folder.hpp"

namespace {

using import_folder::complaint;
using import_folder::Place;
using recoil::ImportFormat;
using recoil::ImportRequest;
using testing::HasSubstr;

/// A file, what is asked besides, and words of the refusal.
struct Refusal {
  std::string text;
  std::function<void(ImportRequest&)> ask;
  std::string words;
};

void expect_refusals(ImportFormat format, const std::vector<Refusal>& refusals) {
  for (const Refusal& refusal : refusals) {
    const Place place;
    ImportRequest request = place.request(refusal.text, format);
    if (refusal.ask) refusal.ask(request);
    EXPECT_THAT(complaint(request), HasSubstr(refusal.words)) << refusal.text;
    EXPECT_FALSE(place.has("made/points.csv")) << refusal.words;
  }
}

std::function<void(ImportRequest&)> map(const std::string& words) {
  return [words](ImportRequest& request) { request.map = {words}; };
}

TEST(ImportRefuses, FiguresWhoseAxesOrBarsAreNotClear) {
  const std::string figure = "s,,top,\nX,Y,X,Y\n2,0.5,2,0.6\n3,0.6,,\n";
  const auto axis = [](const std::string& word) {
    return [word](ImportRequest& request) { request.axes = {word}; };
  };
  const auto bars = [](const std::string& word) {
    return [word](ImportRequest& request) { request.error_series = {word}; };
  };
  expect_refusals(
      ImportFormat::webplotdigitizer,
      {{figure, axis("z=log,1,100"), "names no axis"},
       {figure, axis("log"), "names no axis"},
       {figure, axis("x=cubic,1,100"), "--axis x"},
       {figure, axis("x=linear,1"), "--axis x"},
       {figure, axis("x=linear,1,1"), "--axis x"},
       {figure, [](ImportRequest& r) { r.reading_error = "3mm"; }, "neither a percentage"},
       {figure, map("diameter=x"), "does not suit a figure"},
       {figure, map("restitution=z"), "does not suit a figure"},
       {figure, map("restitution"), "does not suit a figure"},
       {figure, map("restitution=x,rebound_velocity=y:m/s"), "which axis is the incident velocity"},
       {figure, map("incident_velocity=x:mm,restitution=y"), "mm"},
       {figure, bars("s"), "names no ends of bars"},
       {figure, bars("s=top,top,top"), "names no ends of bars"},
       {figure, bars("s=bottom"), "there is no series 'bottom'"},
       {figure, bars("s=top"), "'s' has 2 points and its error bars 'top' have 1 ends"},
       {"s,\nX,Y\n-2,0.5\n", nullptr, "input.csv:3:1: V = -2 m/s"}});
}

TEST(ImportRefuses, TablesWhoseColumnsAreNotClear) {
  expect_refusals(
      ImportFormat::csv,
      {{"", nullptr, "the file is empty"},
       {"V,e\n", map("incident_velocity=V:m/s,restitution=e"), "no row below it"},
       {"V,e\n1,0.5\n", map("incident_velocity"), "is not of the form quantity=column:unit"},
       {"V,e\n1,0.5\n", map("velocity=V:m/s"), "did you mean 'incident_velocity'?"},
       {"V,e\n1,0.5\n", map("incident_velocity=V:m/s,incident_velocity=V:m/s"), "given twice"},
       {"V,e\n1,0.5\n", map("incident_velocity=V:m/s,rebound_velocity=V:m/s"), "is taken for both"},
       {"V,e\n1,0.5\n", map("incident_velocity=V:m/s,restitution=a"), "no column is called 'a'"},
       {"V,a,b,c\n1,.5,.6,.7\n", map("incident_velocity=V+V+V:m/s,restitution=a+b"), "names"},
       {"1,0.5\n2,0.6\n", map("incident_velocity=c:m/s"), "no column is called 'c'"},
       {"a,b\n1,0.5\n", map("restitution=b"), "which column is incident_velocity?"},
       {"V,e,s\n1,0.5 ± 0.1,0.1\n", map("incident_velocity=V:m/s,restitution=e,restitution_sd=s"),
        "restitution_sd has a column of its own"},
       {"V,e,n\n1,0.5,3 ± 1\n", map("incident_velocity=V:m/s,restitution=e,events=n"),
        "no error of events is read"},
       {"V,e,n\n1,0.5,2.5\n", map("incident_velocity=V:m/s,restitution=e,events=n"), "2.5"}});
}

TEST(ImportRefuses, FlightsThatAreNoneInARow) {
  const auto with = [](const std::string& words, const std::string& error) {
    return [words, error](ImportRequest& request) {
      request.map = {words};
      request.time_error = error;
    };
  };
  expect_refusals(
      ImportFormat::intervals,
      {{"t\n0.4\n", with("interval=t:s", "1ms"), "no launch has two successive"},
       {"t\n0.4\n0.3\n", with("interval=t:s", "0ms"), "--time-error '0ms' is not positive"},
       {"t\n0.4\n0.3\n", with("interval=t:s", "-1ms"), "is not positive"},
       {"t\n0.4\n0.4\n0.7\n", with("time=t:s", "1ms"), "a flight of 0 s"},
       {"t\n0.4\n-0.3\n", with("interval=t:s", "1ms"), "-0.3"}});
  expect_refusals(ImportFormat::heights,
                  {{"h1,h2\n1,0.5\n", map("drop_height=h1:m"), "which column is rebound_height?"},
                   {"h1,h2\n1,0.5\n2,\n", map("drop_height=h1:m,rebound_height=h2:kg"), "kg"},
                   {"h1,h2\n1,1.6\n", map("drop_height=h1:m,rebound_height=h2:m"), "restitution"}});
}

TEST(ImportRefuses, BodiesThatAreNoMaterials) {
  const auto particle = [](const std::string& words) {
    return [words](ImportRequest& request) {
      request.map = {"incident_velocity=V:m/s,restitution=e"};
      request.particle = words;
    };
  };
  const std::string table = "V,e\n1,0.5\n";
  expect_refusals(
      ImportFormat::csv,
      {{table, particle("material=steel,heavy"), "'heavy' is not of the form key=value"},
       {table, particle("no-such.json"), "no such file"},
       {table, particle("material=a,density=1,youngs_modulus=1e9,poisson_ratio=0.3,colour=2"),
        "colour"},
       {table,
        [](ImportRequest& r) {
          r.map = {"incident_velocity=V:m/s,restitution=e"};
          r.diameters = {"2kg"};
        },
        "unknown unit 'kg' of --diameter"},
       {table,
        [](ImportRequest& r) {
          r.map = {"incident_velocity=V:m/s,restitution=e"};
          r.into = r.file;
        },
        "this is a file, not a folder"}});
  const Place place;
  ImportRequest request = place.request(table, ImportFormat::csv);
  request.map = {"incident_velocity=V:m/s,restitution=e"};
  place.write("body.json", "[1]");
  request.particle = place / "body.json";
  EXPECT_THAT(complaint(request), HasSubstr("body.json: this is not a JSON object"));
  place.write("body.json",
              "{\"material\": \"a\", \"density\": 1000, \"youngs_modulus\": 1e9, "
              "\"poisson_ratio\": 0.3}");
  EXPECT_EQ(complaint(request), "no error");
}

}  // namespace
