// A good GenerateTransition that the first byte chooses, with the rest of the input appended to it
// as bytes of the wire, which change its fields or make it none.
#include "tests/fuzz/rpc.h"

namespace choreo {
namespace {

v1::GenerateTransitionRequest MakeRequest(int flags) {
  v1::GenerateTransitionRequest request;
  request.set_frames(20);
  request.mutable_config()->set_seed(7);
  if (flags & 1) *request.mutable_target() = fuzz::GoodPose(0.3, 0.8F);
  if (flags & 2) {
    *request.mutable_config()->mutable_audio_format() = fuzz::GoodFormat();
    request.mutable_audio()->set_data(fuzz::GoodMusic(30'000));
  }
  if (flags & 4) request.set_candidates(3);
  if (flags & 8) *request.add_after() = fuzz::GoodPose(0.31, 0.79F);
  if (flags & 16) request.mutable_target_mask()->add_joints(3);
  if (flags & 32)
    *request.mutable_config()->mutable_history()->add_poses() = fuzz::GoodPose(0.1, 0.2F);
  if (flags & 64) request.mutable_controls()->mutable_velocity_factors()->add_factors(1);
  return request;
}

}  // namespace
}  // namespace choreo

FUZZ_TARGET(generate_transition) {
  using namespace choreo;
  static fuzz::RpcServer& server = *new fuzz::RpcServer;
  fuzz::Decisions decisions(data, size);
  const uint8_t flags = decisions.Byte();
  std::string message = flags & 0x80 ? "" : MakeRequest(flags).SerializeAsString();
  const auto rest = decisions.Take(size);
  message.append(rest.begin(), rest.end());
  fuzz::RawStream call(server, "GenerateTransition");
  call.Send(message);
  call.Finish<v1::GenerateTransitionResponse>();
  return 0;
}
