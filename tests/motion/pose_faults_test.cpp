#include "model/motion/pose/pose_faults.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/motion/floor/floor_clearance.h"
#include "model/motion/kinematics/kinematics.h"

namespace choreo::pose_faults_test {

using testing::ElementsAre;
using testing::IsEmpty;

const Skeleton& Body() { return Skeleton::Smpl24(); }

Pose At(double x, double lift = 0) {
  Pose pose = RestPose(Body());
  pose.root_position += Eigen::Vector3d(x, lift, 0);
  return pose;
}

std::vector<std::string> Messages(const std::vector<TimedPose>& poses) {
  std::vector<std::string> messages;
  for (const TimedFault& fault : DanceFaults(Body(), poses))
    messages.push_back(poses[fault.pose].name + ": " + fault.message);
  return messages;
}

TEST(PoseFaults, NamesImpossibleAngles) {
  EXPECT_THAT(PoseFaults(Body(), At(0)), IsEmpty());
  EXPECT_THAT(PoseFaults(Body(), At(0, 0.4)), IsEmpty());  // a jump
  EXPECT_THAT(PoseFaults(Body(), At(0, -0.12)),
              ElementsAre(testing::HasSubstr("_ankle is 12 cm under the floor")));
  EXPECT_THAT(PoseFaults(Body(), At(0, 1.5)),
              ElementsAre("the body hangs 1.5 m above the floor; nobody jumps 1.2 m"));
  Pose knee = At(0);
  const Hinge hinge = Hinges(Body())[1];
  knee.rotations.col(hinge.joint) = -0.7 * hinge.axis;
  knee.root_position.y() = *StandingHeight(Body(), knee);
  EXPECT_THAT(PoseFaults(Body(), knee),
              ElementsAre("right_knee bends 40.11 degrees backwards, further than 15"));
  knee.rotations.col(hinge.joint) = 3 * hinge.axis;
  EXPECT_THAT(PoseFaults(Body(), knee),
              ElementsAre("right_knee bends 171.89 degrees, further than 165"));
  EXPECT_EQ(BendFaults(Body(), knee).size(), 1U);
  EXPECT_THAT(BendFaults(Body(), At(0, 1.5)), IsEmpty());
}

TEST(RestsOnFloor, AHeelIsPartOfAFoot) {
  Skeleton body = Body();
  body.AddJoint("left_heel", body.feet[0], {0, -0.05, -0.05});
  Pose pose = RestPose(body);
  EXPECT_FALSE(RestsOnFloor(body, pose));
  pose.root_position.y() -= 0.5;
  EXPECT_TRUE(RestsOnFloor(body, pose)) << "on its knees";
}

TEST(PoseFaults, MaskedJointsHaveNoFaults) {
  Pose pose = At(0, -0.3);
  const Hinge hinge = Hinges(Body())[0];
  pose.rotations.col(hinge.joint) = -hinge.axis;
  PoseMask head;
  head.root_position = false;
  head.joints.assign(24, false);
  head.joints[15] = true;
  EXPECT_THAT(PoseFaults(Body(), pose, head), IsEmpty());
  // If a key sets only the place, the pelvis is known to be above the floor, but not the feet.
  PoseMask place = head;
  place.root_position = true;
  EXPECT_THAT(PoseFaults(Body(), pose, place), IsEmpty());
}

TEST(DanceFaults, NamesTooFastTransitions) {
  EXPECT_THAT(Messages({{"a", 1, At(0)}, {"b", 1.5, At(4)}}), IsEmpty());
  Pose up = At(0), down = At(0);
  up.rotations(2, Body().left_shoulder) = 1.5;
  down.rotations(2, Body().left_shoulder) = -1.5;
  EXPECT_THAT(Messages({{"up", 1, up}, {"down", 1.5, down}}), IsEmpty());
  EXPECT_THAT(Messages({{"up", 1, up}, {"down", 1.1, down}}),
              ElementsAre(testing::StartsWith("down: left_hand would go 12")));
  PoseMask nowhere;
  nowhere.root_position = false;
  EXPECT_THAT(Messages({{"a", 1, At(0)}, {"b", 1.5, At(4), nowhere}}), IsEmpty());
}

TEST(DanceFaults, NamesBodiesThatStayInTheAir) {
  EXPECT_THAT(Messages({{"a", 1, At(0, 0.4)}, {"b", 1.6, At(0, 0.4)}, {"c", 2.4, At(0)}}),
              IsEmpty());
  EXPECT_THAT(Messages({{"a", 1, At(0, 0.4)}, {"b", 3, At(0, 0.4)}, {"c", 4, At(0)}}),
              ElementsAre("b: the body would be in the air for 2 s, since \"a\"; a jump takes 1"));
}

// A plank in half a second is reached, but by a fall.
TEST(DanceFaults, NamesTheTimeThatAWayToTheFloorTakes) {
  const Pose low = At(0, -0.6);
  EXPECT_THAT(Messages({{"a", 1, At(0)}, {"plank", 1.5, low}}),
              ElementsAre("plank: the pelvis would sink 0.6 m in 0.5 s from \"a\" to \"plank\"; "
                          "that takes 0.6 s, and dancers usually take 1.2"));
  EXPECT_THAT(Messages({{"plank", 1, low}, {"up", 1.5, At(0)}}),
              ElementsAre(testing::HasSubstr("up: the pelvis would rise 0.6 m in 0.5 s")));
  EXPECT_THAT(Messages({{"plank", 0.4, low}}),
              ElementsAre(testing::HasSubstr("in 0.4 s from \"the start\" to \"plank\"")));
  EXPECT_THAT(Messages({{"a", 1, At(0)}, {"plank", 1.7, low}, {"up", 2.4, At(0)}}), IsEmpty());
  // A bend of the knees, and a jump, are no ways to the floor.
  EXPECT_THAT(Messages({{"a", 1, At(0)}, {"bend", 1.2, At(0, -0.25)}}), IsEmpty());
  EXPECT_THAT(Messages({{"bend", 1, At(0, -0.25)}, {"jump", 1.3, At(0, 0.4)}}), IsEmpty());
  // A pose without a place stands or lies on the floor.
  PoseMask nowhere;
  nowhere.root_position = false;
  Pose lying = At(0);
  lying.rotations(0, 0) = 1.5;
  EXPECT_THAT(Messages({{"a", 1, At(0), nowhere}, {"lying", 1.3, lying, nowhere}}),
              ElementsAre(testing::HasSubstr("lying: the pelvis would sink")));
}

TEST(DanceFaults, NamesHitsWithoutTimeForThem) {
  EXPECT_THAT(Messages({{"a", 1, At(0)}, {"b", 1.5, At(0), {}, 3}}),
              ElementsAre("b: a hit of 3 shapes the last 0.8 s of the way, and from \"a\" to \"b\" "
                          "are only 0.5 s, so it hardly shows"));
  EXPECT_THAT(Messages({{"b", 0.5, At(0), {}, 0}}),
              ElementsAre(testing::HasSubstr("from \"the start\" to \"b\"")));
  // A hit of 1 keeps the dance's own timing.
  EXPECT_THAT(Messages({{"a", 1, At(0)}, {"b", 1.5, At(0), {}, 1}, {"c", 2.3, At(0), {}, 3}}),
              IsEmpty());
}

TEST(HoldFault, NamesAJumpThatIsHeldForLongerThanItLasts) {
  Pose up = At(0);
  up.root_position.y() += 0.25 - HeightAboveFloor(Body(), up);
  EXPECT_EQ(HoldFault(Body(), up, {}, 0.4), "");
  EXPECT_EQ(HoldFault(Body(), up, {}, 1),
            "the body is 0.25 m in the air, where a jump keeps it for 0.45 s, not 1 s");
  EXPECT_EQ(HoldFault(Body(), At(0), {}, 8), "");
  PoseMask nowhere;
  nowhere.root_position = false;
  EXPECT_EQ(HoldFault(Body(), up, nowhere, 1), "");
}

}  // namespace choreo::pose_faults_test
