#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "client/authoring/dancers.h"
#include "client/edit.h"
#include "model/body/body_distance.h"

namespace choreo::authoring {

/// The two bodies on a stage that come nearest to each other.
struct NearestPair {
  size_t one = 0, other = 0;
  BodyDistance distance = {};
};

/// Takes at least two dances. `places`: the offset of each from where it was made, metres.
NearestPair FindNearest(const std::vector<MovingBody>& bodies,
                        const std::vector<Eigen::Vector3d>& moved);

/// The least factor, from 1 on, by which to spread places about their middle so that bodies stay
/// `apart`, metres, to a millimetre. No two places are the same.
double WidenFormation(const std::vector<MovingBody>& bodies,
                      const std::vector<Eigen::Vector3d>& places, double apart);

/// The move of each body when places spread by `factor` about their middle.
std::vector<Eigen::Vector3d> MovesOf(const std::vector<Eigen::Vector3d>& places, double factor);

/// The delay in frames of a dancer (Dancer::after) in a dance of `frames`. Counts are those of the
/// beats (seconds) at the music's beginning. Throws Error(kInvalidArgument, field) for counts
/// without beats, and for a delay beyond the dance's end.
int64_t FramesLater(const std::optional<WrittenTime>& after, std::span<const double> beats,
                    double fps, int64_t frames, const std::string& field);

/// A dance as performed by one of its dancers: mirrored, delayed by this many frames, turned and
/// moved to that dancer's place.
client::FinishedDance OnStage(const Skeleton& skeleton, const Dancer& dancer,
                              client::FinishedDance dance, int64_t later);

/// How a formation became.
struct Formed {
  double factor = 1;                        ///< the factor by which they spread about their middle
  std::optional<NearestPair> nearest = {};  ///< of two dancers or more
};

/// Moves dancers on stage apart if they would come nearer than `apart`, metres.
Formed KeepApart(const std::vector<Dancer>& dancers, double apart, const Skeleton& skeleton,
                 std::vector<client::FinishedDance>* dances);

}  // namespace choreo::authoring
