#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/files.hpp"
#include "core/json.hpp"
#include "document/document.hpp"
#include "plot/plot.hpp"

/// What all studies share: the head of their JSON, and the tables and coloured tables of pages.
namespace recoil {

/// The head of every study's JSON: what it is and where its numbers come from.
struct StudyStamp {
  std::string study;    ///< "coverage-designs": the name of its files in reports
  std::string command;  ///< the line that makes it
  std::string key;      ///< of the sources, fits and data that made it, see study_key
  RECOIL_FIELDS(study, command, key)
};

/// The last paragraph of a study's page.
inline std::vector<Block> stamp_blocks(const StudyStamp& stamp) {
  return {Paragraph{say("Made by {} ({}), from sources with the key {}.",
                        code("./run study " + stamp.study), code(stamp.command), code(stamp.key))}};
}

/// The JSON of a study: its stamp, then its fields.
template <class Result>
std::string study_json(const Result& result) {
  Json json = as_json(result.stamp);
  json.update(as_json(result));
  return json_text(json, 1);
}

/// Reads what `study_json` writes.
/// @param what "study of coverage"
/// @param required a key that such a study has
/// @throws InputError when `file` is not such a study
template <class Result>
Result read_study(const std::filesystem::path& file, const std::string& what,
                  const std::string& required) {
  const std::string text = read_text_file(file);
  try {
    const Json json = Json::parse(text);
    if (!json.is_object() || !json.contains("key") || !json.contains(required)) {
      throw std::runtime_error("it has no '" + required + "'");
    }
    Result result;
    read_json(json, result.stamp);
    read_json(json, result);
    return result;
  } catch (const std::exception& problem) {
    throw InputError({file.string()}, "this is no " + what, problem.what(),
                     "let ./run study write it again");
  }
}

/// A column of a table that has one row for each of a study's results.
template <class Row>
struct StudyColumn {
  std::string heading;
  std::function<Cell(const Row&)> cell;
  bool words = false;  ///< to be read rather than compared
};

template <class Row>
Table study_table(const std::vector<Row>& rows, const std::vector<StudyColumn<Row>>& columns) {
  Table table;
  for (const auto& column : columns) table.columns.push_back({column.heading, {}, column.words});
  for (const Row& row : rows) {
    std::vector<Cell>& cells = table.rows.emplace_back();
    for (const auto& column : columns) cells.push_back(column.cell(row));
  }
  return table;
}

inline Cell word_cell(const std::string& word) { return Sentence(word); }
inline Cell count_cell(std::size_t count) { return Sentence(std::to_string(count)); }

/// A table as a plot: the cell of row r and column c is the square about (c, r), the first row on
/// top. Its first layer is for the cells.
inline plot::Plot table_plot(const std::vector<std::string>& rows,
                             const std::vector<std::string>& columns, double letters) {
  plot::Plot panel;
  panel.x.set_range({-0.5, static_cast<double>(columns.size()) - 0.5});
  panel.y.set_range({static_cast<double>(rows.size()) - 0.5, -0.5});
  for (plot::Axis* axis : {&panel.x, &panel.y}) {
    axis->grid = false;
    axis->tick_size = letters;
    for (const std::string& label : axis == &panel.x ? columns : rows) {
      axis->ticks.push_back({static_cast<double>(axis->ticks.size()), label});
    }
  }
  panel.x.upright = true;
  panel.layers.emplace_back(plot::Boxes{});
  return panel;
}

/// Adds the cell of `row` and `column` of such a plot.
inline plot::Boxes& add_cell(plot::Boxes& cells, std::size_t row, std::size_t column) {
  const auto x = static_cast<double>(column);
  const auto y = static_cast<double>(row);
  cells.add(x - 0.5, x + 0.5, y - 0.5, y + 0.5);
  return cells;
}

}  // namespace recoil
