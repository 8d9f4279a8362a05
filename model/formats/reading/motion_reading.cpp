#include "model/formats/reading/motion_reading.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>

#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/core/text/printable.h"

namespace choreo {

void MotionReading::NoteRate(double taken) const {
  Note("states no rate; read as " + Rounded(taken) + " frames a second, --fps sets another");
}

void MotionReading::RefuseBody() const {
  if (!body.empty()) throw InvalidArgument("--body", "the file holds one body");
}

void CheckAngles(const std::string& angles) {
  if (!angles.empty() && angles != "degrees" && angles != "radians")
    throw InvalidArgument("--angles", '"' + Printable(angles) + "\" is none of degrees, radians");
}

Eigen::Vector3d ParseUp(const std::string& up) {
  const bool negative = up.starts_with('-');
  const std::string axis = up.substr(negative || up.starts_with('+') ? 1 : 0);
  const size_t index = std::string("xyz").find(axis);
  if (axis.size() != 1 || index == std::string::npos)
    throw InvalidArgument("--up", "\"" + up + "\" is none of x, y, z, -x, -y, -z");
  return Eigen::Vector3d::Unit(static_cast<Eigen::Index>(index)) * (negative ? -1 : 1);
}

std::string UpName(const Eigen::Vector3d& up) {
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  return std::string(up[axis] < 0 ? "-" : "") + "xyz"[axis];
}

Eigen::Matrix3d TurnToYUp(const Eigen::Vector3d& up) {
  if (up == -Eigen::Vector3d::UnitY())  // there is no shortest turn; use X
    return Eigen::Vector3d(1, -1, -1).asDiagonal();
  return Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

std::optional<size_t> NumberBelow(const std::string& text, size_t limit) {
  size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && number < limit ? std::optional(number) : std::nullopt;
}

size_t ChooseBody(const std::string& body, const std::vector<std::string>& names) {
  const auto named = std::ranges::count(names, body);
  if (named == 1) return static_cast<size_t>(std::ranges::find(names, body) - names.begin());
  if (const auto number = NumberBelow(body, names.size())) return *number;
  throw InvalidArgument("--body", '"' + Printable(body) + "\" is " +
                                      (named > 1 ? "several" : "none") + " of its bodies, " +
                                      ListBodies(names));
}

std::string ListBodies(const std::vector<std::string>& names) {
  constexpr size_t kMaxNames = 8;
  std::string text;
  for (size_t i = 0; i < std::min(names.size(), kMaxNames); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(i) + " \"" + Printable(names[i]) + '"';
  return text + (names.size() > kMaxNames ? " ..." : "");
}

}  // namespace choreo
