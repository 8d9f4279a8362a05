#include "model/training/curves.h"

#include <cstdio>
#include <map>
#include <sstream>
#include <string_view>

#include "model/core/atomic_file.h"
#include "model/core/error.h"
#include "model/draw/plot.h"

namespace choreo {
namespace {

constexpr std::string_view kGradientSuffix = "_gradient";
constexpr std::string_view kRatio = "_ratio_";  // in the names of figures that are compared

std::string Format(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

}  // namespace

void Curves::Append(const LossRow& losses, double seconds, const NamedFigures& figures) {
  std::string header = "step,seconds";
  std::string line = std::to_string(losses.step) + "," + Format(seconds);
  for (const auto& [name, figure] : losses.terms) {
    header += "," + name + "," + name + std::string(kGradientSuffix);
    line += "," + Format(figure.value) + "," + Format(figure.gradient);
  }
  for (const auto& [name, value] : figures) {
    header += "," + name;
    line += "," + Format(value);
  }
  header_ = header;
  lines_.push_back(line);
}

std::string Curves::Serialise() const {
  std::string text = header_ + "\n";
  for (const std::string& line : lines_) text += line + "\n";
  return text;
}

void Curves::Restore(const std::string& csv) {
  std::istringstream stream(csv);
  std::getline(stream, header_);
  lines_.clear();
  for (std::string line; std::getline(stream, line);) lines_.push_back(line);
}

void Curves::Write(const std::filesystem::path& folder) const {
  WriteFile(folder / "curves.csv", Serialise());

  // Columns back out of the text: a restored run has nothing else.
  std::vector<std::string> names;
  std::istringstream header(header_);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::map<std::string, std::vector<double>> columns;
  for (const std::string& line : lines_) {
    std::istringstream stream(line);
    size_t i = 0;
    for (std::string cell; std::getline(stream, cell, ',') && i < names.size(); ++i) {
      columns[names[i]].push_back(std::stod(cell));
    }
  }
  // Zero means "not computed yet": a plot leaves those points out.
  const auto series = [&](const std::string& name) {
    PlotSeries result;
    result.label = name;
    for (size_t i = 0; i < columns[name].size(); ++i) {
      if (columns[name][i] == 0) continue;
      result.x.push_back(columns["step"][i]);
      result.y.push_back(columns[name][i]);
    }
    return result;
  };
  const auto plot = [&](const std::string& title, const std::string& y,
                        const std::vector<std::string>& wanted, const std::string& file_name) {
    Plot figure;
    figure.title = title;
    figure.x_label = "step";
    figure.y_label = y;
    for (const std::string& name : wanted) {
      PlotSeries one = series(name);
      if (!one.x.empty()) figure.series.push_back(std::move(one));
    }
    if (!figure.series.empty()) DrawPlot(figure, folder / file_name);
  };
  std::vector<std::string> values, gradients, ratios;
  for (const std::string& name : names) {
    if (name.find(kRatio) != std::string::npos) ratios.push_back(name);
    if (!name.ends_with(kGradientSuffix)) continue;
    gradients.push_back(name);
    values.push_back(name.substr(0, name.size() - kGradientSuffix.size()));
  }
  plot("Training losses", "loss", values, "curves.png");
  plot("Gradient of each weighted term", "norm", gradients, "gradients.png");
  plot("Validation, ratio to interpolation", "ratio", ratios, "validation.png");
}

}  // namespace choreo
