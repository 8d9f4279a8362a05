#include "model/training/trainer/curves.h"

#include <algorithm>
#include <sstream>
#include <string_view>

#include "model/core/files/atomic_file.h"
#include "model/draw/plot.h"

namespace choreo {
namespace {

constexpr std::string_view kGradientSuffix = "_gradient";
constexpr std::string_view kRatio = "_ratio_";  // in the names of figures that are compared

std::vector<std::string> CellsOf(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

void Curves::Append(int64_t step, double seconds, const LossFigures& losses,
                    const NamedFigures& figures) {
  names_.clear();
  std::vector<double>& row = rows_.emplace_back();
  const auto add = [&](const std::string& name, double value) {
    names_.push_back(name);
    row.push_back(value);
  };
  add("step", static_cast<double>(step));
  add("seconds", seconds);
  for (const auto& [name, figure] : losses) {
    add(name, figure.value);
    add(name + std::string(kGradientSuffix), figure.gradient);
  }
  for (const auto& [name, value] : figures) add(name, value);
}

std::string Curves::Serialise() const {
  std::ostringstream text;
  for (size_t i = 0; i < names_.size(); ++i) text << (i > 0 ? "," : "") << names_[i];
  for (const std::vector<double>& row : rows_) {
    text << '\n' << static_cast<int64_t>(row[0]);
    for (size_t i = 1; i < row.size(); ++i) text << ',' << row[i];
  }
  text << '\n';
  return text.str();
}

void Curves::Restore(const std::string& csv) {
  std::istringstream stream(csv);
  std::string line;
  std::getline(stream, line);
  names_ = CellsOf(line);
  rows_.clear();
  while (std::getline(stream, line)) {
    std::vector<double>& row = rows_.emplace_back();
    for (const std::string& cell : CellsOf(line)) row.push_back(std::stod(cell));
  }
}

void Curves::Write(const std::filesystem::path& folder) const {
  WriteFile(folder / "curves.csv", Serialise());
  const auto plot = [&](const std::string& title, const std::string& y, const std::string& file,
                        auto is_shown) {
    Plot figure{.title = title, .x_label = "step", .y_label = y, .series = {}};
    for (size_t i = 2; i < names_.size(); ++i) {
      if (!is_shown(names_[i])) continue;
      PlotSeries series{.label = names_[i], .x = {}, .y = {}};
      for (const std::vector<double>& row : rows_) {
        if (i >= row.size() || row[i] == 0) continue;  // not computed yet
        series.x.push_back(row[0]);
        series.y.push_back(row[i]);
      }
      if (!series.x.empty()) figure.series.push_back(std::move(series));
    }
    if (!figure.series.empty()) DrawPlot(figure, folder / file);
  };
  const auto is_gradient = [](const std::string& name) { return name.ends_with(kGradientSuffix); };
  const auto is_loss = [&](const std::string& name) {
    return std::ranges::find(names_, name + std::string(kGradientSuffix)) != names_.end();
  };
  const auto is_ratio = [](const std::string& name) {
    return name.find(kRatio) != std::string::npos;
  };
  plot("Training losses", "loss", "curves.png", is_loss);
  plot("Gradient of each weighted term", "norm", "gradients.png", is_gradient);
  plot("Validation, ratio to interpolation", "ratio", "validation.png", is_ratio);
}

}  // namespace choreo
