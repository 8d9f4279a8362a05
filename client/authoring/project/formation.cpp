#include "client/authoring/project/formation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "client/arrange.h"
#include "model/core/error.h"
#include "model/core/rounded.h"
#include "model/motion/rotation.h"

namespace choreo::authoring {

NearestPair FindNearest(const std::vector<MovingBody>& bodies,
                        const std::vector<Eigen::Vector3d>& moved) {
  NearestPair nearest{.distance = {std::numeric_limits<double>::infinity(), 0}};
  for (size_t i = 0; i < bodies.size(); ++i) {
    for (size_t j = i + 1; j < bodies.size(); ++j) {
      const BodyDistance distance = LeastDistance(bodies[i], bodies[j], moved[j] - moved[i]);
      if (distance.metres < nearest.distance.metres) nearest = {i, j, distance};
    }
  }
  return nearest;
}

double WidenFormation(const std::vector<MovingBody>& bodies,
                      const std::vector<Eigen::Vector3d>& places, double apart) {
  constexpr double kStep = 0.001;  // metres
  double factor = 1;
  // The distance between bodies grows at most as fast as that between their places, so each step
  // is necessary.
  for (double step = 1; step > 0;) {
    const std::vector<Eigen::Vector3d> moved = MovesOf(places, factor);
    step = 0;
    for (size_t i = 0; i < bodies.size(); ++i) {
      for (size_t j = i + 1; j < bodies.size(); ++j) {
        const double missing =
            apart - LeastDistance(bodies[i], bodies[j], moved[j] - moved[i]).metres;
        const double way = (places[j] - places[i]).norm();
        if (missing > 0) step = std::max(step, std::max(missing, kStep) / way);
      }
    }
    factor += step;
  }
  return factor;
}

std::vector<Eigen::Vector3d> MovesOf(const std::vector<Eigen::Vector3d>& places, double factor) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& place : places) middle += place / static_cast<double>(places.size());
  std::vector<Eigen::Vector3d> moved;
  for (const Eigen::Vector3d& place : places) moved.push_back((factor - 1) * (place - middle));
  return moved;
}

int64_t FramesLater(const std::optional<WrittenTime>& after, std::span<const double> beats,
                    double fps, int64_t frames, const std::string& field) {
  if (!after) return 0;
  const double from = beats.empty() ? 0 : beats.front();
  const double seconds = after->After(from, {{beats.begin(), beats.end()}}, field) - from;
  const int64_t later = std::llround(seconds * fps);
  if (later < frames) return later;
  throw InvalidArgument(field, InFull(seconds) + " s later is after the end of the dance");
}

client::FinishedDance OnStage(const Skeleton& skeleton, const Dancer& dancer,
                              client::FinishedDance dance, int64_t later) {
  if (dancer.mirrored) dance = client::Mirrored(skeleton, dance);
  const auto frames = std::ssize(dance.motion.frames);
  later = std::min<int64_t>(frames - 1, later);
  client::FinishedDance waits = client::PartOf(dance, 0, 1);
  waits.motion.frames.resize(static_cast<size_t>(later), waits.motion.frames.front());
  if (!waits.contacts.empty())
    waits.contacts.resize(static_cast<size_t>(later), waits.contacts.front());
  if (later > 0) dance = client::Join(std::move(waits), client::PartOf(dance, 0, frames - later));
  const GroundFrame place{.origin = {dancer.place.x(), 0, dancer.place.y()},
                          .heading = dancer.facing / kDegrees};
  dance.motion = client::Moved(std::move(dance.motion), GroundFrame(), place);
  return dance;
}

Formed KeepApart(const std::vector<Dancer>& dancers, double apart, const Skeleton& skeleton,
                 std::vector<client::FinishedDance>* dances) {
  std::vector<MovingBody> bodies;
  std::vector<Eigen::Vector3d> places;
  for (size_t i = 0; i < dances->size(); ++i) {
    bodies.emplace_back(skeleton, (*dances)[i].motion);
    places.emplace_back(dancers[i].place.x(), 0, dancers[i].place.y());
  }
  Formed formed;
  if (apart > 0) formed.factor = WidenFormation(bodies, places, apart);
  if (formed.factor > 1) formed.asked = FindNearest(bodies, MovesOf(places, 1));
  const std::vector<Eigen::Vector3d> moved = MovesOf(places, formed.factor);
  for (size_t i = 0; i < dances->size(); ++i) {
    for (Pose& pose : (*dances)[i].motion.frames) pose.root_position += moved[i];
  }
  if (bodies.size() > 1) formed.nearest = FindNearest(bodies, moved);
  return formed;
}

}  // namespace choreo::authoring
