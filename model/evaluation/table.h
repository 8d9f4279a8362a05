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

/// A figure; NaN where there is none (a dash in Markdown, null in JSON).
struct Cell {
  Cell(double v = NAN, std::optional<Interval> i = {}) : value(v), interval(i) {}
  double value;
  std::optional<Interval> interval;  ///< 95 %
};

/// What one window of a clip came to.
struct ClipFigure {
  size_t clip = 0;  ///< within its set
  double value = 0;
};

/// One figure of each of `some`, which know their clip, times `unit`. `figure`: a member or a
/// function of one.
template <typename Figures, typename Figure>
std::vector<ClipFigure> FiguresOf(const std::vector<Figures>& some, Figure figure,
                                  double unit = 1) {
  std::vector<ClipFigure> figures;
  for (const Figures& one : some) figures.push_back({one.clip, unit * std::invoke(figure, one)});
  return figures;
}

/// Sum over windows of `above` over that of `below`, with its interval over clips; NaN where that
/// is nothing.
Cell Ratio(const std::vector<ClipFigure>& above, const std::vector<ClipFigure>& below);
/// Mean over windows with its interval over clips; NaN of none.
Cell Mean(const std::vector<ClipFigure>& figures);
template <typename Figures, typename Figure>
Cell Mean(const std::vector<Figures>& some, Figure figure, double unit = 1) {
  return Mean(FiguresOf(some, figure, unit));
}
/// Mean of the means of several groups of windows (lengths, say), with its interval over the clips
/// of all.
Cell MeanOfMeans(const std::vector<std::vector<ClipFigure>>& groups);

struct Column {
  std::string heading;  ///< with unit
  int digits = 2;
};

struct TableRow {
  std::vector<std::string> labels;  ///< as many as Table::label_headings
  std::vector<Cell> cells;          ///< as many as Table::columns
};

/// A table of results: what the evaluation prints, writes as JSON and as Markdown ready to paste.
struct Table {
  std::string name;  ///< of its JSON entry and its plot's file: "transitions_dancedb"
  std::string title;
  std::string note;  ///< one paragraph: what was measured, on how much
  std::vector<std::string> label_headings;
  std::vector<Column> columns;
  std::vector<TableRow> rows;
  std::optional<Plot> plot;

  /// Begins a row.
  void Begin(std::vector<std::string> labels) { rows.push_back({std::move(labels), {}}); }
  /// The next cell of the last row; the first row makes the columns.
  void Put(const std::string& heading, int digits, Cell cell);
};

/// A heading, the note, the table, its columns padded so that plain text reads well too.
std::string ToMarkdown(const Table& table);
nlohmann::json ToJson(const Table& table);

}  // namespace choreo
