#pragma once

#include <cmath>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "model/draw/plot.h"
#include "model/metrics/bootstrap.h"

namespace choreo {

/// A figure, or NaN for none, which is a dash in Markdown and null in JSON.
struct Cell {
  Cell(double v = NAN, std::optional<Interval> i = {}) : value(v), interval(i) {}
  double value;
  std::optional<Interval> interval;  ///< 95 %
};

/// A figure of one window of a clip.
struct ClipFigure {
  size_t clip = 0;  ///< index in its set
  double value = 0;
};

/// A figure of each element of `some`, times `unit`, with the element's clip. `figure`: a member or
/// a function.
template <typename Figures, typename Figure>
std::vector<ClipFigure> FiguresOf(const std::vector<Figures>& some, Figure figure,
                                  double unit = 1) {
  std::vector<ClipFigure> figures;
  for (const Figures& one : some) figures.push_back({one.clip, unit * std::invoke(figure, one)});
  return figures;
}

/// The sum of `above` over the sum of `below`, with its interval over clips. NaN if the sum of
/// `below` is 0.
Cell Ratio(const std::vector<ClipFigure>& above, const std::vector<ClipFigure>& below);
/// The mean over windows, with its interval over clips. NaN for none.
Cell Mean(const std::vector<ClipFigure>& figures);
template <typename Figures, typename Figure>
Cell Mean(const std::vector<Figures>& some, Figure figure, double unit = 1) {
  return Mean(FiguresOf(some, figure, unit));
}
/// The mean of the means of several groups of windows (such as lengths), with its interval over all
/// clips.
Cell MeanOfMeans(const std::vector<std::vector<ClipFigure>>& groups);

struct Column {
  std::string heading;  ///< with unit
  int digits = 2;
};

struct TableRow {
  std::vector<std::string> labels;  ///< one per Table::label_headings
  std::vector<Cell> cells;          ///< one per Table::columns
};

/// A table of results, for printing, JSON, and Markdown that can be pasted.
struct Table {
  std::string name;  ///< of its JSON entry and its plot's file, such as "transitions_dancedb"
  std::string title;
  std::string note;  ///< one paragraph: what was measured, on how much data
  std::vector<std::string> label_headings;
  std::vector<Column> columns;
  std::vector<TableRow> rows;
  std::optional<Plot> plot;

  void AddRow(std::vector<std::string> labels) { rows.push_back({std::move(labels), {}}); }
  /// Adds a cell to the last row; the first row defines the columns.
  void Put(const std::string& heading, int digits, Cell cell);
};

/// Heading, note and table as Markdown, padded to be readable as plain text.
std::string ToMarkdown(const Table& table);
nlohmann::json ToJson(const Table& table);

}  // namespace choreo
