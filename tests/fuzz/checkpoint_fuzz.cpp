#include "model/flow/checkpoint/checkpoint_file.h"
#include "model/flow/window/continuous_flow_config.h"
#include "model/papers/networks/flow_config.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/input_file.h"

FUZZ_TARGET(checkpoint) {
  using namespace choreo;
  static const fuzz::InputFile input(".safetensors");
  fuzz::MayRefuse([&] {
    Safetensors content = ReadSafetensors(input.Holding(fuzz::Text(data, size)));
    // As somebody would who means harm: the hash is right.
    content.metadata["hash"] = ContentHash(content, "hash");
    const std::string format = content.metadata["format"];
    const CheckpointFile file(content, "a.safetensors", format);
    fuzz::MayRefuse([&] { file.skeleton(); });
    fuzz::MayRefuse([&] { file.Get<FlowConfig>("config"); });
    fuzz::MayRefuse([&] { file.Get<ContinuousFlowConfig>("config"); });
  });
  return 0;
}
