#include <filesystem>
#include <iostream>

#include "tests/support/character_rigs.h"

// Characters for other programs to open.
//   write_characters FOLDER
int main(int count, char** arguments) {
  using namespace choreo::testing_support;
  if (count != 2) {
    std::cerr << "write_characters FOLDER\n";
    return 1;
  }
  const std::filesystem::path folder = arguments[1];
  WriteCharacter(folder / "mixamo.glb", {.arms_down = 45, .rolled = true, .armature_scale = 0.01});
  WriteCharacter(folder / "child.glb",
                 {.rig = "Unreal", .prefix = "", .body = ChildBody(), .arms_down = 50});
  WriteCharacter(
      folder / "long.glb",
      {.rig = "Rigify", .prefix = "DEF-", .body = LongLegs(), .arms_down = 20, .rolled = true});
  WriteCharacter(folder / "nameless.glb", {.rig = "", .prefix = "", .arms_down = 30});
}
