#include "model/fit/bones/guess_bones.h"
#include "model/fit/bones/transfer.h"
#include "model/formats/gltf/character_file.h"
#include "model/motion/kinematics/kinematics.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

FUZZ_TARGET(character) {
  using namespace choreo;
  static const fuzz::InputFile input(".glb"), out(".out.glb");
  fuzz::MayRefuse([&] {
    const CharacterFile file(input.Holding(fuzz::Text(data, size)));
    const Eigen::Matrix3Xd places = file.places();
    HumanBones bones = file.FindBones();
    if (!MissingBones(bones).empty())
      bones = GuessBones(file.nodes().parents, places, file.rig().joints);
    const CharacterBody body = MakeCharacterBody(bones, places);
    const Skeleton& smpl = Skeleton::Smpl24();
    const Motion dance{.fps = 30, .frames = {RestPose(smpl), RestPose(smpl)}};
    const auto& written = out.Holding("");
    file.WriteDance(written, body, TransferToCharacter(dance, body.skeleton));
    // What we write is a character, too.
    try {
      if (CharacterFile(written).nodes().names != file.nodes().names)
        fuzz::Fail("other nodes came out");
    } catch (const Error& error) {
      fuzz::Fail(error.what());
    }
  });
  return 0;
}
