#include <algorithm>
#include <utility>

#include "model/evaluation/judges/control_course.h"
#include "model/metrics/control_figures.h"
#include "model/metrics/joint_track.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/rotation.h"

namespace choreo {
namespace {

constexpr int kFrames = 90;
constexpr int kAside = 1;  // metres beside the straight path, in its middle

enum class Drawing { kDanced, kStraight, kOnTheSpot, kBow };

constexpr std::pair<const char*, Drawing> kPaths[] = {{"as danced", Drawing::kDanced},
                                                      {"straight", Drawing::kStraight},
                                                      {"on the spot", Drawing::kOnTheSpot},
                                                      {"a bow", Drawing::kBow}};

Eigen::Vector2d OnFloor(const Eigen::Vector3d& place) { return {place.x(), place.z()}; }

// Draws a path without heights, which lead from the dancer's to the key's.
RootPath Draw(Drawing way, ControlledWindow* window) {
  const Eigen::Vector3d start = window->before.root_position;
  Eigen::Vector3d& end = window->key.root_position;
  RootPath path;
  if (way == Drawing::kOnTheSpot) end = {start.x(), end.y(), start.z()};
  if (way == Drawing::kBow) {
    const Eigen::Vector3d left = HeadingRotation(Heading(ExpMap(window->before.rotations.col(0)))) *
                                 Eigen::Vector3d::UnitX();
    path.frames = {0, kFrames / 2, kFrames - 1};
    path.points = {OnFloor(start), OnFloor((start + end) / 2 + kAside * left), OnFloor(end)};
  } else {
    path.frames = {0, kFrames - 1};
    path.points = {OnFloor(start + (end - start) / kFrames), OnFloor(end)};
  }
  return path;
}

double PathSpeed(const ControlledWindow& window, double fps) {
  Eigen::Vector3d last = window.before.root_position;
  double length = 0;
  for (const auto point : window.path.colwise()) {
    length += (point - last).norm();
    last = point;
  }
  return length * fps / window.path.cols();
}

}  // namespace

std::vector<Table> EvaluateDrawnPaths(const Evaluation& evaluation) {
  const ModelInfo& model = evaluation.model();
  if (!model.Supports(kRootPath)) return {};
  Table table = evaluation.NewTable("drawn", "Drawn paths", {"path", "method"});
  table.note = std::to_string(kFrames) +
               " frames between real poses on paths that nobody danced, no velocity factors asked "
               "for. On the spot: the key stands where the dancer does. A bow: " +
               std::to_string(kAside) +
               " m to the dancer's left in the middle. Of the key's joints the worst.";
  const Skeleton& skeleton = model.skeleton;
  for (const auto& [name, shape] : kPaths) {
    ControlCourse course(evaluation, kFrames);
    if (shape != Drawing::kDanced)
      course.Redraw([&, shape = shape](ControlledWindow* window) { return Draw(shape, window); });
    for (const Method& way : WaysOf(evaluation.methods)) {
      if (!way.FollowsPath() || !way.keys) continue;
      if (way.kind == Method::Kind::kReal && shape != Drawing::kDanced) continue;
      const Dances dances = course.Dance(way);
      const auto put = [&](const char* heading, int digits, const ControlCourse::Figure& figure) {
        table.Put(heading, digits, Mean(course.FiguresOf(dances, figure)));
      };
      table.AddRow({name, way.name});
      put("root asked m/s", 2,
          [&](const auto& window, const auto&) { return PathSpeed(window, model.fps); });
      put("skating", 2, [&](const auto& window, const auto& danced) {
        return SkateRatioOf(skeleton, model.fps, window.before, danced);
      });
      put("root off path mean cm", 1, [&](const auto& window, const auto& danced) {
        return 100 * RootDeviation(TrackJoints(skeleton, danced), window.path);
      });
      put("key missed cm", 2, [&](const auto& window, const auto& danced) {
        return 100 * ComparePoses(skeleton, danced.back(), window.key).position_m;
      });
      put("a joint off degrees", 1, [&](const auto& window, const auto& danced) {
        return ComparePoses(skeleton, danced.back(), window.key).angle_deg;
      });
    }
  }
  return {table};
}

}  // namespace choreo
