#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/project/dancers.h"
#include "client/edit.h"
#include "model/body/body_distance.h"

namespace choreo::authoring {

/// The two bodies on a stage that come nearest to each other, by index, and their distance.
struct NearestPair {
  size_t one = 0, other = 0;
  BodyDistance distance = {};
};

/// Finds the nearest pair of at least two bodies. `moved`: each body's offset from where its dance
/// was made, metres.
NearestPair FindNearest(const std::vector<MovingBody>& bodies,
                        const std::vector<Eigen::Vector3d>& moved);

/// Returns the least factor, at least 1, by which to spread places about their middle so that
/// bodies stay `apart` metres from each other, to a millimetre. Requires distinct places.
double WidenFormation(const std::vector<MovingBody>& bodies,
                      const std::vector<Eigen::Vector3d>& places, double apart);

/// The offset of each body when places are spread by `factor` about their middle, metres.
std::vector<Eigen::Vector3d> MovesOf(const std::vector<Eigen::Vector3d>& places, double factor);

/// Converts a dancer's delay (Dancer::after) in a dance of `frames` to frames. Reads counts with
/// the beats (seconds) at the music's beginning. Throws Error(kInvalidArgument, field) for counts
/// without beats, and for a delay beyond the dance's end.
int64_t FramesLater(const std::optional<WrittenTime>& after, std::span<const double> beats,
                    double fps, int64_t frames, const std::string& field);

/// Returns a dance as performed by one of its dancers: mirrored if the dancer is, delayed by
/// `later` frames, turned, and moved to the dancer's place.
client::FinishedDance OnStage(const Skeleton& skeleton, const Dancer& dancer,
                              client::FinishedDance dance, int64_t later);

/// The result of KeepApart.
struct Formed {
  double factor = 1;  ///< by which the dancers' places were spread about their middle
  std::optional<NearestPair> nearest = {};  ///< none for a single dancer
  std::optional<NearestPair> asked = {};    ///< at the requested places, if these were spread
};

/// Spreads dancers who would come nearer to each other than `apart`, metres. 0: leaves them at
/// their places.
Formed KeepApart(const std::vector<Dancer>& dancers, double apart, const Skeleton& skeleton,
                 std::vector<client::FinishedDance>* dances);

}  // namespace choreo::authoring
