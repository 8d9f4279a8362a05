#include "model/motion/controls/controls.h"

#include <algorithm>
#include <utility>

#include "model/core/error.h"
#include "model/core/rounded.h"

namespace choreo {
namespace {

constexpr std::pair<BodyPart, BodyPart> kSides[] = {{BodyPart::kLeftArm, BodyPart::kRightArm},
                                                    {BodyPart::kLeftLeg, BodyPart::kRightLeg}};

// Places are [x, y, z]; code for body parts counts on a channel for each.
void CheckChannels(const ControlRow& row) {
  int wanted = row.channels;
  if (row.space == ControlSpace::kPlace || row.features == ControlFeatures::kOffMean) wanted = 3;
  if (row.space == ControlSpace::kPerPart || row.features == ControlFeatures::kLevel)
    wanted = kBodyParts;
  if (row.channels == wanted) return;
  throw InvalidArgument(
      "controls." + std::string(row.name),
      std::to_string(row.channels) + " channels, must be " + std::to_string(wanted));
}

void CheckCurve(const ControlRow& row, const ControlCurve& curve, int frames,
                const std::string& field) {
  const Eigen::MatrixXd& values = curve.values;
  if (values.rows() != row.channels) {
    throw InvalidArgument(field, std::to_string(values.rows()) + " numbers a frame, must be " +
                                     std::to_string(row.channels));
  }
  if (values.cols() != frames) {
    throw InvalidArgument(
        field, std::to_string(values.cols()) + " frames, must be " + std::to_string(frames));
  }
  if (!values.allFinite()) throw InvalidArgument(field, "not finite");
  if (values.minCoeff() >= row.least) return;
  throw InvalidArgument(field, RoundedBeyond(values.minCoeff(), row.least) + ' ' +
                                   std::string(row.unit) + ", must be at least " +
                                   Rounded(row.least));
}

}  // namespace

size_t FindControl(std::string_view name) {
  return static_cast<size_t>(std::ranges::find(kControls, name, &ControlRow::name) - kControls);
}

std::vector<std::string> ControlNames() {
  std::vector<std::string> names;
  for (const ControlRow& row : kControls) names.emplace_back(row.name);
  return names;
}

Controls::Controls(std::span<const ControlRow> rows) : rows_(rows), curves_(rows.size()) {
  for (size_t i = 0; i < rows.size(); ++i) {
    CheckChannels(rows[i]);
    curves_[i].requested.assign(static_cast<size_t>(rows[i].channels), true);
  }
}

void Controls::Check(std::span<const std::string> taken, const std::string& model,
                     int frames) const {
  for (size_t i = 0; i < rows_.size(); ++i) {
    if (!curves_[i].IsGiven()) continue;
    const std::string field = "controls." + std::string(rows_[i].name);
    if (std::ranges::find(taken, rows_[i].name) == taken.end())
      throw InvalidArgument(field, "the model '" + model + "' does not take it");
    CheckCurve(rows_[i], curves_[i], frames, field);
  }
}

Controls Controls::Part(int from, int count) const {
  Controls part = *this;
  for (ControlCurve& curve : part.curves_) {
    if (curve.IsGiven()) curve.values = curve.values.middleCols(from, count).eval();
  }
  return part;
}

void Controls::ToLocal(const GroundFrame& ground) {
  for (size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].space != ControlSpace::kPlace) continue;
    for (auto place : curves_[i].values.colwise()) place = ground.ToLocal(Eigen::Vector3d(place));
  }
}

void Controls::Mirror() {
  for (size_t i = 0; i < rows_.size(); ++i) {
    ControlCurve& curve = curves_[i];
    if (rows_[i].space == ControlSpace::kPlace && curve.IsGiven()) curve.values.row(0) *= -1;
    if (rows_[i].space != ControlSpace::kPerPart) continue;
    for (const auto& [left, right] : kSides) {
      const auto l = static_cast<size_t>(left), r = static_cast<size_t>(right);
      std::vector<bool>::swap(curve.requested[l], curve.requested[r]);
      if (curve.IsGiven())
        curve.values.row(static_cast<Eigen::Index>(l))
            .swap(curve.values.row(static_cast<Eigen::Index>(r)));
    }
  }
}

}  // namespace choreo
