// Dances for two and a half seconds without music: from rest to a pose with raised arms.
//   first_dance HOST:PORT
#include <client/choreo_client.h>
#include <model/motion/kinematics/kinematics.h>

#include <iostream>

int main(int argc, char** argv) try {
  const std::string address = argc > 1 ? argv[1] : "127.0.0.1:50051";

  const choreo::client::Client client({.addresses = {address}});
  const choreo::Skeleton body = client.GetServerInfo().models.front().skeleton;
  const choreo::client::KeyPose rest{.id = "rest", .time_s = 0, .pose = choreo::RestPose(body)};
  choreo::client::KeyPose arms_up{.id = "arms up", .time_s = 2.5, .pose = rest.pose};
  arms_up.pose.root_position.z() += 0.3;                // metres; Y is up
  arms_up.pose.rotations(2, body.left_shoulder) = 1.0;  // axis-angle, radians
  arms_up.pose.rotations(2, body.right_shoulder) = -1.0;
  const auto dance = client.Dance({.seed = 1}, {rest, arms_up}, /*audio=*/{});
  std::cout << dance.motion.frames.size() << " frames, " << dance.report.keys.size() << " keys\n";

  return 0;
} catch (const choreo::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
