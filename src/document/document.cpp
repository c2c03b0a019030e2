#include "document/document.hpp"

#include <algorithm>
#include <utility>

namespace recoil {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

bool is_empty(const Cell& cell) {
  const auto* words = std::get_if<Sentence>(&cell);
  return std::holds_alternative<std::monostate>(cell) || (words != nullptr && words->empty());
}

}  // namespace

Sentence words_of_cell(const Cell& cell) {
  return std::visit(Overloaded{[](std::monostate) { return Sentence("–"); },
                               [](const Sentence& words) { return words; },
                               [](const Number& quantity) { return quantity.words(); },
                               [](const NumberRange& range) { return Sentence(range.text()); }},
                    cell);
}

bool Table::has_headings() const {
  return std::ranges::any_of(columns,
                             [](const TableColumn& column) { return !column.heading.empty(); });
}

Table without_empty_columns(Table table) {
  for (auto& row : table.rows) row.resize(table.columns.size());
  for (std::size_t column = table.columns.size(); column-- > 1;) {
    const bool needed =
        std::ranges::any_of(table.rows, [&](const auto& row) { return !is_empty(row[column]); });
    if (needed) continue;
    const auto place = static_cast<std::ptrdiff_t>(column);
    table.columns.erase(table.columns.begin() + place);
    for (auto& row : table.rows) row.erase(row.begin() + place);
  }
  return table;
}

Table items(const std::vector<std::pair<Sentence, Cell>>& entries) {
  Table table;
  table.columns = {{}, {{}, "", true}};
  for (const auto& [name, value] : entries) {
    if (!is_empty(value)) table.rows.push_back({name, value});
  }
  return table;
}

Figure figure_of(plot::Picture picture, Sentence caption) {
  Figure figure{picture.name, picture.title, std::move(caption), "", {}};
  figure.picture = std::move(picture);
  return figure;
}

bool empty(const Block& block) {
  return std::visit(Overloaded{[](const List& list) { return list.entries.empty(); },
                               [](const Table& table) { return table.empty(); },
                               [](const Figures& figures) { return figures.figures.empty(); },
                               [](const auto& one) { return one.text.empty(); }},
                    block.content());
}

bool empty(const Section& section) {
  return std::ranges::all_of(section.blocks, [](const Block& block) { return empty(block); });
}

void append(Blocks& blocks, Blocks more) {
  for (Block& block : more) blocks.push_back(std::move(block));
}

std::vector<const Figure*> figures_of(const Section& section) {
  std::vector<const Figure*> all;
  for (const Block& block : section.blocks) {
    const auto* const figures = std::get_if<Figures>(&block.content());
    if (figures == nullptr) continue;
    for (const Figure& figure : figures->figures) all.push_back(&figure);
  }
  return all;
}

}  // namespace recoil
