#include "model/formats/gltf/gltf.h"
#include "model/formats/gltf/gltf_scene.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

FUZZ_TARGET(glb) {
  using namespace choreo;
  static const fuzz::InputFile input(".glb");
  fuzz::MayRefuse([&] {
    const auto& path = input.Holding(fuzz::Text(data, size));
    const GltfScene scene = ReadGltfScene(path);
    scene.Frame(0);
    scene.Frame(scene.frames - 1);
    // Longer ones take as long as they are.
    if (scene.frames < 5) ReadGlb(path);
  });
  return 0;
}
