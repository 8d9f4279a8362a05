#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/bare_product.h"
#include "bench/flow_probe.h"
#include "bench/random_checkpoints.h"
#include "model/core/grid.h"
#include "model/core/running/threads.h"
#include "model/engine/packed/kernels.h"
#include "model/engine/packed/matrix.h"
#include "model/flow/window/flow_tokens.h"
#include "model/flow/window/window_features.h"
#include "model/motion/kinematics/kinematics.h"
#include "model/motion/pose/pose_codec.h"
#include "model/plan/footwork.h"
#include "model/samplers/samplers.h"

/// Measures transitions of both engines beside their limits: bare matrix products of the same
/// shapes, and memory bandwidth. Everything runs on one thread and is measured in that thread's CPU
/// time, which other load affects less. Quote ratios from one run.
///
/// `default` is the shipped model, a continuous flow that samples a whole transition. `paper` has
/// paper F's size and random weights, and samples frame by frame. With a GPU, `paper` also runs
/// there.
namespace choreo {
namespace {

/// What a run measures, besides Google Benchmark's flags.
struct Options {
  std::filesystem::path probes;  ///< folder for checkpoints and probes; empty: none
  /// The packed engine's float32 kernels, as an older CPU has them. Only they and bare products
  /// with the same instructions run then. Empty: all that this machine has.
  std::string kernels;
};

/// The models of a run, and a temporary folder for them.
class Models {
 public:
  explicit Models(std::string kernels) : kernels_(std::move(kernels)) {
    std::filesystem::create_directories(folder_);
    paths_["default"] =
        std::filesystem::path(CHOREO_SOURCE_DIR) / "model/checkpoints/default.safetensors";
    paths_["paper"] = folder_ / "paper.safetensors";
    WriteRandomCheckpoint(paths_["paper"], FlowConfig::Preset("paper"), Skeleton::Smpl24(), 1);
  }
  ~Models() { std::filesystem::remove_all(folder_); }
  Models(const Models&) = delete;
  Models& operator=(const Models&) = delete;

  const std::filesystem::path& Path(const std::string& model) const { return paths_.at(model); }
  Sampler& Get(const std::string& model, const std::string& kind, const Device& device = {}) {
    std::unique_ptr<Sampler>& sampler = samplers_[model + kind + device.name()];
    if (!sampler) {
      sampler = std::move(
          MakeSamplers(paths_.at(model), {&device, 1}, ParseEngineKind(kind), kernels_).front());
    }
    return *sampler;
  }

 private:
  std::string kernels_;
  std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("engine_bench_" + std::to_string(getpid()));
  std::map<std::string, std::filesystem::path> paths_;
  std::map<std::string, std::unique_ptr<Sampler>> samplers_;
};

TransitionSpec Spec(const ModelInfo& model, uint64_t seed) {
  TransitionSpec spec;
  spec.frames = kTypicalFrames;
  spec.history.assign(static_cast<size_t>(model.history_frames), RestPose(model.skeleton));
  Pose key = RestPose(model.skeleton);
  key.root_position.x() += 0.5;
  spec.target = Target{key, {}};
  spec.seed = seed;
  spec.temperature = static_cast<float>(model.default_temperature);
  if (model.music_features) {
    spec.music = {Eigen::MatrixXf::Zero(model.music_features.count, model.history_frames),
                  Eigen::MatrixXf::Zero(model.music_features.count, spec.frames)};
  }
  if (model.Supports(kRootPath)) {
    const Eigen::Vector3d from = spec.history.back().root_position;
    const Eigen::Vector3d way = key.root_position - from;
    spec.controls[kRootPath].values =
        (way * Eigen::RowVectorXd::LinSpaced(kTypicalFrames, 1.0 / kTypicalFrames, 1)).colwise() +
        from;
  }
  return spec;
}

/// Transitions of kTypicalFrames, one after another.
void Transitions(benchmark::State& state, Sampler& sampler, const std::vector<double>& beats) {
  TransitionSpec spec = Spec(sampler.model(), 1);
  spec.beats = beats;
  const ValidSpec valid(std::move(spec), sampler.model());
  for (auto _ : state) benchmark::DoNotOptimize(sampler.Sample(valid).Finish());
  state.SetItemsProcessed(state.iterations());
}

/// The work that the server adds to a sampled transition: footwork.
void Feet(benchmark::State& state, Sampler& sampler) {
  const TransitionSpec spec = Spec(sampler.model(), 1);
  const std::vector<Pose> drawn = sampler.Sample(ValidSpec(spec, sampler.model())).Finish().poses;
  const FootworkContext context{.skeleton = sampler.model().skeleton,
                                .history = spec.history,
                                .keyed = true,
                                .fps = sampler.model().fps,
                                .options = sampler.model().plan_options.footwork};
  for (auto _ : state) {
    std::vector<Pose> plan = drawn;
    benchmark::DoNotOptimize(StandOnFeet(context, &plan));
  }
  state.SetItemsProcessed(state.iterations());
}

/// The packed engine's products for one frame.
std::vector<BareProducts::Shape> Shapes(const FlowConfig& config, int width) {
  const int tau = config.history_frames, hidden = config.hidden, low = width / 2;
  const int live = tau * width + (tau + 1) * config.audio_features + 1;
  const int condition = config.condition_width > 0 ? config.condition_width : live;
  std::vector<BareProducts::Shape> shapes;
  if (config.condition_width > 0) shapes = {{live, condition}, {condition, condition}};
  const int aimed = config.innovations ? PoseCodec(Skeleton::Smpl24()).velocity_at() : 0;
  for (int step = 0; step < config.flow_steps; ++step) {
    shapes.push_back({condition + aimed + low + hidden, 4 * hidden});
    shapes.push_back({2 * hidden, 4 * hidden});
    shapes.push_back({hidden, 2 * (width - low)});
    shapes.push_back({width, width});
  }
  return shapes;
}

/// The continuous flow's products for one transition of kTypicalFrames.
std::vector<BareProducts::Shape> Shapes(const ContinuousFlowConfig& config,
                                        const Skeleton& skeleton) {
  const int dimensions = 3 + 3 * skeleton.joints(), width = config.width;
  const int tokens = (config.history_frames + kTypicalFrames + kFramesAToken - 1) / kFramesAToken;
  const int token = kFramesAToken * TokenFrameWidth(dimensions, FrameFeatures());
  std::vector<BareProducts::Shape> shapes;
  for (int step = 0; step < config.steps; ++step) {
    shapes.push_back({token, width, tokens});
    for (int layer = 0; layer < config.layers; ++layer) {
      shapes.push_back({width, 3 * width, tokens});
      shapes.push_back({width, width, tokens});
      shapes.push_back({width, kMlpRatio * width, tokens});
      shapes.push_back({kMlpRatio * width, width, tokens});
    }
    shapes.push_back({width, 2 * kFramesAToken * dimensions, tokens});
  }
  return shapes;
}

/// The bare products of one transition: `products`, `times` times.
void Bare(benchmark::State& state, BareProducts& products, int times) {
  for (auto _ : state) {
    for (int i = 0; i < times; ++i) products.Run();
  }
  state.SetItemsProcessed(state.iterations());
  state.SetBytesProcessed(state.iterations() * times * static_cast<int64_t>(products.bytes()));
  state.counters["flops"] = benchmark::Counter(times * products.operations(),
                                               benchmark::Counter::kIsIterationInvariantRate);
}

/// Reads several places at once with the widest vectors, because a core that reads word after word
/// does not reach full bandwidth.
[[gnu::target_clones("avx512f", "avx2", "default")]] uint64_t SumOf(const uint64_t* words,
                                                                    size_t count) {
  constexpr size_t kPlaces = 8, kLanes = 8;
  const size_t part = count / kPlaces;
  uint64_t sums[kPlaces][kLanes] = {};
  for (size_t i = 0; i + kLanes <= part; i += kLanes) {
    for (size_t place = 0; place < kPlaces; ++place) {
      for (size_t lane = 0; lane < kLanes; ++lane)
        sums[place][lane] += words[place * part + i + lane];
    }
  }
  uint64_t total = 0;
  for (const auto& place : sums) {
    for (const uint64_t sum : place) total += sum;
  }
  return total;
}

void ReadMemory(benchmark::State& state) {
  constexpr size_t kCount = size_t{100} << 20;  // floats, far more than any cache holds
  const LargePages pages(kCount);
  const auto* words = reinterpret_cast<const uint64_t*>(pages.data());
  for (auto _ : state) {
    uint64_t sum = SumOf(words, kCount / 2);
    benchmark::DoNotOptimize(sum);
  }
  state.SetBytesProcessed(state.iterations() * static_cast<int64_t>(kCount * sizeof(float)));
}

void Register(Models* models, bool floats_alone) {
  const bool bf16 = !floats_alone && !Bf16KernelsHere().empty();
  std::vector<std::string> kinds = {"packed"};
  if (!floats_alone) kinds.push_back("torch");
  if (bf16) kinds.push_back("packed-bf16");
  const auto add = [&](const std::string& name, auto run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Unit(benchmark::kMillisecond);
  };
  const std::string model = "paper";
  for (const std::string& kind : kinds) {
    add("paper/" + kind,
        [=](benchmark::State& state) { Transitions(state, models->Get(model, kind), {}); });
  }
  const int width = 3 + 3 * Skeleton::Smpl24().joints() + 3 + 4;
  for (const bool half : bf16 ? std::vector{false, true} : std::vector{false}) {
    add(std::string("paper/") + (half ? "bare-bf16" : "bare"), [=](benchmark::State& state) {
      BareProducts products(Shapes(FlowConfig::Preset(model), width), 1, half);
      Bare(state, products, kTypicalFrames);
    });
  }
  // Wall time: the thread waits for the GPU.
  if (TorchDevices().cuda_devices > 0) {
    benchmark::RegisterBenchmark(
        "paper/cuda/torch",
        [=](benchmark::State& state) {
          Transitions(state, models->Get(model, "torch", {Device::Kind::kCuda, 0}), {});
        })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
  for (const std::string& kind : kinds) {
    add("default/" + kind,
        [=](benchmark::State& state) { Transitions(state, models->Get("default", kind), {}); });
    add("default/to_beats/" + kind, [=](benchmark::State& state) {
      Transitions(state, models->Get("default", kind), {0, 15, 30, 45, 60});  // 120 a minute
    });
  }
  add("default/feet",
      [=](benchmark::State& state) { Feet(state, models->Get("default", kinds.back())); });
  for (const bool half : bf16 ? std::vector{false, true} : std::vector{false}) {
    add(std::string("default/") + (half ? "bare-bf16" : "bare"), [=](benchmark::State& state) {
      BareProducts products(Shapes(ContinuousFlowConfig{}, Skeleton::Smpl24()), 0, half);
      Bare(state, products, 1);
    });
  }
  benchmark::RegisterBenchmark("memory", ReadMemory)->Unit(benchmark::kMillisecond);
}

int Measure(const Options& options, Models* models) {
  if (const std::filesystem::path& folder = options.probes; !folder.empty()) {
    std::filesystem::create_directories(folder);
    const std::filesystem::path checkpoint = folder / "paper.safetensors";
    std::filesystem::copy_file(models->Path("paper"), checkpoint,
                               std::filesystem::copy_options::overwrite_existing);
    WriteFlowProbe(checkpoint, folder / "paper.probe.safetensors");
  }
  std::string kernels = options.kernels;
  if (kernels.empty()) {
    kernels = PackedKernelsHere().front()->name;
    if (!Bf16KernelsHere().empty()) kernels += std::string(", ") + Bf16KernelsHere().front()->name;
  } else {
    LimitBareProducts(kernels);
  }
  benchmark::AddCustomContext("kernels", kernels);
  benchmark::AddCustomContext("blas", DetectBlas().name);
  Register(models, !options.kernels.empty());
  if (TorchDevices().cuda_devices > 0) {
    const auto gpu = models->Get("paper", "torch", {Device::Kind::kCuda, 0}).model().fingerprint;
    benchmark::AddCustomContext("gpu", gpu.substr(gpu.rfind('/') + 1));
  }
  return benchmark::RunSpecifiedBenchmarks() > 0 ? 0 : 2;
}

}  // namespace
}  // namespace choreo

/// engine_bench [--probes FOLDER] [--kernels NAME]: `--probes` also writes checkpoints and probes
/// for bench/peer_torch.py into FOLDER.
int main(int argc, char** argv) {
  using namespace choreo;
  benchmark::Initialize(&argc, argv);
  Options options;
  for (; argc >= 3 && argv[1][0] == '-'; argc -= 2, argv += 2) {
    const std::string flag = argv[1];
    if (flag == "--probes") {
      options.probes = argv[2];
    } else if (flag == "--kernels") {
      options.kernels = argv[2];
    } else {
      break;
    }
  }
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  SetTorchThreads(1);
  FlushDenormals();
  try {
    Models models(options.kernels);
    return Measure(options, &models);
  } catch (const std::exception& error) {
    std::cerr << "engine_bench: " << error.what() << '\n';
    return 1;
  }
}
