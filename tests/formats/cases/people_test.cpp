// Arrays of several people, and of one in a mirror.
#include <map>
#include <string>
#include <vector>

#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"
#include "tests/support/pickles.h"

namespace choreo::people_test {

using namespace cases_test;

TEST_F(CasesTest, TheLogOfBodiesInArrays) {
  constexpr int kFrames = 20;
  std::vector<double> poses, trans, places;
  Motion mirrored{.fps = 30, .frames = {}};
  for (int frame = 0; frame < kFrames; ++frame) {
    Pose pose = RestPose(kSmpl);
    pose.root_position.x() = 0.05 * frame;
    pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
    pose.rotations.col(kSmpl.left_knee) << 0.03 * frame, 0, 0;
    pose.rotations.col(kSmpl.right_shoulder) << 0, 0, 1.2;
    mirrored.frames.push_back(pose);
    poses.insert(poses.end(), pose.rotations.data(), pose.rotations.data() + 66);
    trans.insert(trans.end(), pose.root_position.begin(), pose.root_position.end());
    Eigen::Matrix3Xd at = JointPositions(kSmpl, pose);
    at.row(0) *= -1;
    places.insert(places.end(), at.data(), at.data() + 66);
  }
  const NpyArray rate{{}, std::vector<double>{30}};
  NpzArchive joints;
  joints.SetArray("joints", {{kFrames, 22, 3}, places});
  joints.SetArray("fps", rate);
  const Read read = ReadNpz(joints);
  EXPECT_TRUE(read.Says("its left and right are exchanged")) << Said(read);
  // The dance in a mirror: the other leg is lifted, and the way goes the other way.
  const JointPlacement end = ForwardKinematics(kSmpl, read.motion.frames.back());
  EXPECT_GT(end.positions(1, kSmpl.Find("right_ankle")),
            end.positions(1, kSmpl.Find("left_ankle")) + 0.03);
  EXPECT_NEAR(read.motion.frames.back().root_position.x(),
              read.motion.frames.front().root_position.x() - 0.95, 0.05);

  const std::map<std::string, NpyArray> arrays = {
      {"poses", {{kFrames, 66}, poses}}, {"trans", {{kFrames, 3}, trans}}, {"fps", rate}};
  NpzArchive flat;
  for (const auto& [key, array] : arrays) flat.SetArray(key, array);
  const Motion base = ReadNpz(flat, {.up = "y"}).motion;
  WritePickledDicts(folder_ / "a.pkl", {{"smpl", arrays}});
  const Read nested = ReadFile("a.pkl", {.up = "y"});
  EXPECT_TRUE(nested.Says("the arrays of its \"smpl\" are read")) << Said(nested);
  EXPECT_LT(WorstJoint(base, nested.motion), 1e-6);
  // The person in the second dict, or in the second row, stays in place.
  std::map<std::string, NpyArray> still = arrays;
  still["trans"] = {{kFrames, 3}, std::vector<double>(3 * kFrames, 0.0)};
  const auto way = [](const Read& one) {
    return (one.motion.frames.back().root_position - one.motion.frames.front().root_position)
        .norm();
  };
  WritePickledDicts(folder_ / "a.pkl", {{"camera", arrays}, {"world", still}});
  ExpectError(ErrorCode::kInvalidArgument,
              "a.pkl: holds 2 motions, 0 \"camera\", 1 \"world\": choreo convert --body reads one",
              [&] { ReadFile("a.pkl"); });
  for (const char* body : {"world", "1"})
    EXPECT_NEAR(way(ReadFile("a.pkl", {.up = "y", .body = body})), 0, 1e-9);
  EXPECT_NEAR(way(ReadFile("a.pkl", {.up = "y", .body = "camera"})), 0.95, 1e-6);

  // As WHAM's: the camera's view of a motion, and the motion; tracks by their numbers.
  NpzArchive seen;
  seen.SetArray("pose", still["poses"]);
  seen.SetArray("trans", still["trans"]);
  seen.SetArray("pose_world", arrays.at("poses"));
  seen.SetArray("trans_world", arrays.at("trans"));
  const Read world = ReadNpz(seen, {.up = "y"});
  EXPECT_NEAR(way(world), 0.95, 1e-6);
  EXPECT_TRUE(world.Says("its pose_world and trans_world are read")) << Said(world);

  NpzArchive two;
  std::vector<double> twice = poses, ways = trans, twice_places = places;
  twice.insert(twice.end(), poses.begin(), poses.end());
  ways.resize(2 * trans.size());
  twice_places.insert(twice_places.end(), places.begin(), places.end());
  two.SetArray("poses", {{2, kFrames, 66}, twice});
  two.SetArray("trans", {{2, kFrames, 3}, ways});
  const Read one = ReadNpz(two, {.up = "y"});
  EXPECT_TRUE(one.Says("its poses are of 2 people; 0 is read, --body 0 to 1 chooses")) << Said(one);
  EXPECT_NEAR(way(one), 0.95, 1e-6);
  EXPECT_NEAR(way(ReadNpz(two, {.up = "y", .body = "0"})), 0.95, 1e-6);
  EXPECT_NEAR(way(ReadNpz(two, {.up = "y", .body = "1"})), 0, 1e-9);
  ExpectError(ErrorCode::kInvalidArgument, "--body: \"2\", must be 0 to 1",
              [&] { ReadNpz(two, {.body = "2"}); });
  NpzArchive placed;
  placed.SetArray("joints", {{2, kFrames, 22, 3}, twice_places});
  EXPECT_TRUE(ReadNpz(placed).Says("its joints are of 2 people; 0 is read"));
  EXPECT_NEAR(way(ReadNpz(placed, {.body = "1"})), 0.95, 0.05);
  // Frames first, people within them.
  std::vector<double> paired, paired_ways;
  for (size_t frame = 0; frame < kFrames; ++frame) {
    for (int person = 0; person < 2; ++person) {
      paired.insert(paired.end(), &poses[66 * frame], &poses[66 * frame] + 66);
      for (size_t i = 0; i < 3; ++i) paired_ways.push_back(person == 0 ? trans[3 * frame + i] : 0);
    }
  }
  two.SetArray("poses", {{kFrames, 2, 66}, paired});
  two.SetArray("trans", {{kFrames, 2, 3}, paired_ways});
  EXPECT_LT(WorstJoint(base, ReadNpz(two, {.up = "y"}).motion), 1e-6);
  EXPECT_NEAR(way(ReadNpz(two, {.up = "y", .body = "1"})), 0, 1e-9);

  // A list of dicts, alone and within a dict.
  for (const char* within : {"", "people"}) {
    SCOPED_TRACE(within);
    WritePickledList(folder_ / "a.pkl", within, {arrays, still});
    const Read first = ReadFile("a.pkl", {.up = "y"});
    EXPECT_TRUE(first.Says("holds 2 motions, 0 \"0\", 1 \"1\"; 0 is read, --body chooses"))
        << Said(first);
    EXPECT_LT(WorstJoint(base, first.motion), 1e-6);
    EXPECT_NEAR(way(ReadFile("a.pkl", {.up = "y", .body = "1"})), 0, 1e-9);
  }
  // Frames of one tracked body are no bodies.
  std::map<std::string, NpyArray> frame = arrays;
  frame["poses"] = {{1, 66}, std::vector<double>(poses.begin(), poses.begin() + 66)};
  frame["trans"] = {{1, 3}, std::vector<double>(3, 0.0)};
  WritePickledList(folder_ / "a.pkl", "", {frame, frame, frame});
  ExpectError(ErrorCode::kInvalidArgument, "a.pkl: holds 3 dicts of one frame each",
              [&] { ReadFile("a.pkl"); });
  EXPECT_EQ(ReadFile("a.pkl", {.body = "2"}).motion.frames.size(), 1U);
  ExpectError(ErrorCode::kInvalidArgument, "--body: the file holds one body",
              [&] { ReadNpz(flat, {.body = "0"}); });
}

}  // namespace choreo::people_test
