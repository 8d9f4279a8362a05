// Dances five seconds without music: from rest, through a pose with raised arms, back to rest.
//   first_dance HOST:PORT
#include <client/choreo_client.h>

#include <iostream>

int main(int argc, char** argv) try {
  choreo::client::Options options;
  if (argc > 1) options.addresses = {argv[1]};
  const choreo::client::Client client(options);
  const choreo::Skeleton skeleton = client.GetServerInfo().models.front().skeleton;

  choreo::client::KeyPose arms_up{.id = "arms up", .time_s = 2.5};
  arms_up.pose.root_position = {0, skeleton.pelvis_height, 0.3};
  arms_up.pose.rotations = Eigen::Matrix3Xd::Zero(3, skeleton.joints());
  arms_up.pose.rotations(2, skeleton.left_shoulder) = 1.0;
  arms_up.pose.rotations(2, skeleton.right_shoulder) = -1.0;
  choreo::client::KeyPose rest = arms_up;
  rest.id = "rest";
  rest.time_s = 5;
  rest.pose.rotations.setZero();

  const auto dance = client.Dance({.seed = 1}, {arms_up, rest}, /*audio=*/{});
  std::cout << dance.motion.frames.size() << " frames; the hips end at "
            << dance.motion.frames.back().root_position.transpose() << '\n';
  return 0;
} catch (const choreo::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
