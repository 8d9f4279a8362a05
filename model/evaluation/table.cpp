#include "model/evaluation/table.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

namespace choreo {
namespace {

std::string Fixed(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  char text[64];
  std::snprintf(text, sizeof(text), "%.*f", digits, value);
  return text;
}

std::string Show(const Cell& cell, int digits) {
  std::string text = Fixed(cell.value, digits);
  // Omits intervals without width.
  if (cell.interval && cell.interval->low < cell.interval->high) {
    text +=
        " (" + Fixed(cell.interval->low, digits) + "–" + Fixed(cell.interval->high, digits) + ")";
  }
  return text;
}

// Counts characters, not bytes: an en dash is one.
size_t Width(const std::string& text) {
  return static_cast<size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

nlohmann::json Number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

}  // namespace

Cell Ratio(const std::vector<ClipFigure>& above, const std::vector<ClipFigure>& below) {
  std::map<size_t, std::pair<double, double>> clips;
  double over = 0, under = 0;
  for (const ClipFigure& figure : above) {
    clips[figure.clip].first += figure.value;
    over += figure.value;
  }
  for (const ClipFigure& figure : below) {
    clips[figure.clip].second += figure.value;
    under += figure.value;
  }
  if (above.empty() || under == 0) return {};
  std::vector<double> numerators, denominators;
  for (const auto& [clip, sums] : clips) {
    numerators.push_back(sums.first);
    denominators.push_back(sums.second);
  }
  return {over / under, BootstrapRatio(numerators, denominators)};
}

Cell Mean(const std::vector<ClipFigure>& figures) { return MeanOfMeans({figures}); }

Cell MeanOfMeans(const std::vector<std::vector<ClipFigure>>& groups) {
  std::vector<ClipFigure> above, below;
  for (const std::vector<ClipFigure>& group : groups) {
    // All groups have equal weight, independent of their number of windows.
    const double weight = groups.size() == 1 ? 1 : 1 / static_cast<double>(group.size());
    for (const ClipFigure& figure : group) {
      above.push_back({figure.clip, weight * figure.value});
      below.push_back({figure.clip, weight});
    }
  }
  return Ratio(above, below);
}

void Table::Put(const std::string& heading, int digits, Cell cell) {
  if (rows.size() == 1) columns.push_back({heading, digits});
  rows.back().cells.push_back(cell);
}

std::string ToMarkdown(const Table& table) {
  const size_t labels = table.label_headings.size();
  std::vector<std::vector<std::string>> lines = {table.label_headings};
  for (const Column& column : table.columns) lines[0].push_back(column.heading);
  for (const TableRow& row : table.rows) {
    std::vector<std::string>& line = lines.emplace_back(row.labels);
    for (size_t i = 0; i < row.cells.size(); ++i)
      line.push_back(Show(row.cells[i], table.columns[i].digits));
  }
  std::vector<size_t> widths(lines[0].size(), 3);
  for (const auto& line : lines) {
    for (size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], Width(line[i]));
  }
  std::string rule = "|";
  for (size_t i = 0; i < widths.size(); ++i) {
    const std::string dashes(widths[i], '-');
    rule += i < labels ? ":" + dashes + "-|" : "-" + dashes + ":|";
  }
  std::string text = "### " + table.title + "\n\n";
  if (!table.note.empty()) text += table.note + "\n\n";
  for (size_t number = 0; number < lines.size(); ++number) {
    text += "|";
    for (size_t i = 0; i < widths.size(); ++i) {
      const std::string& value = lines[number][i];
      const std::string padding(widths[i] - Width(value), ' ');
      text += " " + (i < labels ? value + padding : padding + value) + " |";
    }
    text += number == 0 ? "\n" + rule + "\n" : "\n";
  }
  return text;
}

nlohmann::json ToJson(const Table& table) {
  nlohmann::json rows = nlohmann::json::array();
  for (const TableRow& row : table.rows) {
    nlohmann::json entry;
    for (size_t i = 0; i < row.labels.size(); ++i) entry[table.label_headings[i]] = row.labels[i];
    for (size_t i = 0; i < row.cells.size(); ++i) {
      const Cell& cell = row.cells[i];
      entry[table.columns[i].heading] = Number(cell.value);
      if (cell.interval) {
        entry[table.columns[i].heading + " interval"] = {Number(cell.interval->low),
                                                         Number(cell.interval->high)};
      }
    }
    rows.push_back(entry);
  }
  return {{"name", table.name}, {"title", table.title}, {"note", table.note}, {"rows", rows}};
}

}  // namespace choreo
