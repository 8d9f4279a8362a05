#include "client/live/vmc.h"

#include <lo/lo.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "model/core/error.h"
#include "model/motion/rotation.h"
#include "network/address.h"
#include "network/protocol.h"

namespace choreo::live {
namespace {

// Joints by Skeleton's names, and VRM's bones. Omits SMPL's hands, which move no other joint.
constexpr std::pair<const char*, const char*> kBones[] = {
    {"spine1", "Spine"},
    {"spine2", "Chest"},
    {"spine3", "UpperChest"},
    {"neck", "Neck"},
    {"head", "Head"},
    {"left_collar", "LeftShoulder"},
    {"left_shoulder", "LeftUpperArm"},
    {"left_elbow", "LeftLowerArm"},
    {"left_wrist", "LeftHand"},
    {"right_collar", "RightShoulder"},
    {"right_shoulder", "RightUpperArm"},
    {"right_elbow", "RightLowerArm"},
    {"right_wrist", "RightHand"},
    {"left_hip", "LeftUpperLeg"},
    {"left_knee", "LeftLowerLeg"},
    {"left_ankle", "LeftFoot"},
    {"left_foot", "LeftToes"},
    {"right_hip", "RightUpperLeg"},
    {"right_knee", "RightLowerLeg"},
    {"right_ankle", "RightFoot"},
    {"right_foot", "RightToes"},
};

/// The messages for one moment.
class Bundle {
 public:
  Bundle() : bundle_(lo_bundle_new(lo_timetag{0, 1})) {}  // OSC's "at once"
  ~Bundle() { lo_bundle_free_recursive(bundle_); }
  Bundle(const Bundle&) = delete;
  Bundle& operator=(const Bundle&) = delete;

  void Add(const char* path, int32_t value) {
    lo_message message = lo_message_new();
    lo_message_add_int32(message, value);
    lo_bundle_add_message(bundle_, path, message);
  }
  void Add(const char* path, float value) {
    lo_message message = lo_message_new();
    lo_message_add_float(message, value);
    lo_bundle_add_message(bundle_, path, message);
  }
  void Add(const char* path, const char* name, const Eigen::Vector3d& position,
           const Eigen::Quaterniond& rotation) {
    lo_message message = lo_message_new();
    lo_message_add_string(message, name);
    // VMC's x has the opposite sign.
    for (const double value : {-position.x(), position.y(), position.z(), rotation.x(),
                               -rotation.y(), -rotation.z(), rotation.w()})
      lo_message_add_float(message, static_cast<float>(value));
    lo_bundle_add_message(bundle_, path, message);
  }
  bool SendTo(lo_address address) const { return lo_send_bundle(address, bundle_) >= 0; }

 private:
  lo_bundle bundle_;
};

lo_address Resolve(const std::string& address) {
  const auto [host, port] = SplitAddress(address);
  if (host.empty() || port.empty())
    throw InvalidArgument("--vmc", "\"" + address + "\" is not HOST:PORT");
  if (ParsePort(port).value_or(0) < 1)
    throw InvalidArgument("--vmc", "\"" + address + "\" has the port " + port +
                                       ", which is not a whole number from 1 to " +
                                       std::to_string(kMaxPort));
  return lo_address_new(WithoutBrackets(host).c_str(), port.c_str());
}

}  // namespace

struct VmcSender::Impl {
  struct Bone {
    int joint;
    const char* name;
  };

  Impl(const std::string& named, const Skeleton& body)
      : skeleton(body), address(Resolve(named), lo_address_free) {
    skeleton.RequireRoles();
    for (const auto& [joint, name] : kBones) {
      if (const int found = skeleton.Find(joint); found >= 0) bones.push_back({found, name});
    }
    // Sends a first bundle, which announces a dancer, because the host is resolved only on sending.
    Bundle bundle;
    bundle.Add("/VMC/Ext/OK", int32_t{0});
    if (!bundle.SendTo(address.get())) {
      const char* reason = lo_address_errstr(address.get());
      throw InvalidArgument("--vmc", "\"" + named + "\" can't be reached: " +
                                         (reason ? reason : "it is not an address"));
    }
  }

  Skeleton skeleton;
  std::unique_ptr<void, void (*)(lo_address)> address;
  std::vector<Bone> bones;
};

VmcSender::VmcSender(const std::string& address, const Skeleton& skeleton)
    : impl_(std::make_unique<Impl>(address, skeleton)) {}
VmcSender::~VmcSender() = default;

void VmcSender::Send(const Pose& pose, double seconds) {
  constexpr const char* kBonePath = "/VMC/Ext/Bone/Pos";
  const auto turn = [&](int joint) { return QuaternionFromExp(pose.rotations.col(joint)); };
  const Eigen::Vector3d& root = pose.root_position;
  Bundle bundle;
  bundle.Add("/VMC/Ext/OK", int32_t{1});
  bundle.Add("/VMC/Ext/T", static_cast<float>(seconds));
  bundle.Add("/VMC/Ext/Root/Pos", "root", {root.x(), 0, root.z()}, Eigen::Quaterniond::Identity());
  bundle.Add(kBonePath, "Hips", {0, root.y(), 0}, turn(0));
  for (const Impl::Bone& bone : impl_->bones)
    bundle.Add(kBonePath, bone.name, impl_->skeleton.offsets.col(bone.joint), turn(bone.joint));
  bundle.SendTo(impl_->address.get());
}

}  // namespace choreo::live
