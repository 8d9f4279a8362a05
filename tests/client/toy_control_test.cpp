#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "client/authoring/project/project_file.h"
#include "client/cli/options/authoring_options.h"
#include "client/cli/report/report_controls.h"
#include "model/dance/controls/control_track.h"
#include "model/dance/transition/dance_score.h"
#include "model/flow/window/window_features.h"
#include "proto/wire/control_messages.h"
#include "tests/flow/flow_scene.h"
#include "tests/support/expect_error.h"
#include "tests/support/toy_control.h"

namespace choreo {
namespace toy {

/// Where the dancer looks in each frame: the latest request, interpolated between its rows.
class GazeTrack {
 public:
  static void Check(const Gaze& gaze, const ModelInfo& /*model*/, const std::string& field) {
    if (!gaze.IsWhole()) throw InvalidArgument(field, "there must be a place for each frame");
  }
  ChangedFrames Set(const Gaze& gaze, int64_t from) {
    requests_.push_back({from, std::make_shared<Gaze>(gaze)});
    return {};
  }
  void Fill(const ModelInfo& /*model*/, const std::string& /*key_id*/, TransitionSpec* spec,
            ControlCurve* curve, std::vector<Warning>* /*warnings*/) const {
    if (requests_.empty()) return;
    const Gaze& gaze = *requests_.back().what;
    const auto rows =
        Eigen::Map<const Eigen::Matrix3Xd>(gaze.values.data(), 3, std::ssize(gaze.values) / 3);
    curve->values.resize(3, spec->frames);
    for (int i = 0; i < spec->frames; ++i) {
      const auto [row, share] = PlaceAmong(gaze.frames, spec->first_frame + i);
      const auto at = static_cast<Eigen::Index>(row);
      curve->values.col(i) = rows.col(at);
      if (share > 0) curve->values.col(i) += double{share} * (rows.col(at + 1) - rows.col(at));
    }
  }

 private:
  std::vector<EffectiveFrom<Gaze>> requests_;
};

}  // namespace toy

template <>
struct TrackFor<toy::Gaze> {
  using Track = toy::GazeTrack;
};

}  // namespace choreo

// A control that people write reaches the network and the report through code that does not name
// it. Only its row, its request, its track and its message are its own.
namespace choreo::toy_way_test {

using Track = ControlTrackOf<toy::ControlRequest, toy::EachControl<TrackOf>>;

const nlohmann::json kGaze = {{"frames", {0, 20}}, {"values", {1, 2, 3, 5, 2, 3}}};

class ToyControl : public ::testing::Test {
 protected:
  ToyControl() {
    google::protobuf::FileDescriptorProto file;
    EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
        R"(name: "toy.proto" syntax: "proto3" package: "toy"
           message_type {
             name: "Gaze"
             field { name: "frames" number: 1 label: LABEL_REPEATED type: TYPE_INT64 }
             field { name: "values" number: 2 label: LABEL_REPEATED type: TYPE_FLOAT }
           }
           message_type {
             name: "Controls"
             field { name: "root_path" number: 1 label: LABEL_OPTIONAL type: TYPE_MESSAGE
                     type_name: ".choreo.v1.RootPath" }
             field { name: "velocity_factors" number: 2 label: LABEL_OPTIONAL type: TYPE_MESSAGE
                     type_name: ".choreo.v1.VelocityFactors" }
             field { name: "gaze" number: 3 label: LABEL_OPTIONAL type: TYPE_MESSAGE
                     type_name: ".toy.Gaze" }
           })",
        &file));
    file.add_dependency(v1::Controls::descriptor()->file()->name());
    sent_.reset(
        factory_.GetPrototype(pool_.BuildFile(file)->FindMessageTypeByName("Controls"))->New());
  }

  toy::ControlRequest Read(const authoring::WrittenControls& written,
                           std::vector<std::string> taken = {"gaze"}) const {
    return written.Read<toy::ControlRequest>({.name = "toy", .controls = std::move(taken)},
                                             {.models = {}, .limits = {}}, {}, toy::kRows);
  }
  static authoring::WrittenControls InProject(const nlohmann::json& gaze) {
    const nlohmann::json file = {
        {"studio", 1}, {"controls", {{"gaze", gaze}}}, {"keyframes", nlohmann::json::array()}};
    return authoring::ParseProject(file, "p.json", toy::kRows).controls;
  }

  google::protobuf::DescriptorPool pool_{google::protobuf::DescriptorPool::generated_pool()};
  google::protobuf::DynamicMessageFactory factory_{&pool_};
  std::unique_ptr<google::protobuf::Message> sent_;
};

TEST_F(ToyControl, GoesFromAProjectToTheNetworkAndTheReport) {
  const toy::ControlRequest asked = Read(InProject(kGaze));
  wire::WriteControls(asked, sent_.get(), toy::kRows);
  toy::ControlRequest heard;
  wire::ReadControls(*sent_, "controls", &heard, toy::kRows);

  ModelInfo model;
  model.skeleton = Skeleton::Smpl24();
  EXPECT_THROW(CheckControls(heard, model, "controls", toy::kRows), Error);
  model.controls = {"gaze"};
  CheckControls(heard, model, "controls", toy::kRows);
  Track track(model);
  track.Set(heard, 0, "controls");
  TransitionSpec spec;
  spec.frames = 30;
  spec.first_frame = 5;
  spec.controls = Controls(toy::kRows);
  std::vector<Warning> warnings;
  track.FillControls("key", &spec, &warnings);
  const Eigen::MatrixXd& gaze = spec.controls[toy::kGaze].values;
  ASSERT_EQ(gaze.cols(), 30);
  EXPECT_EQ(gaze.col(0), Eigen::Vector3d(2, 2, 3)) << "a quarter of the way";
  EXPECT_EQ(gaze.col(29), Eigen::Vector3d(5, 2, 3)) << "and then it stays";

  const FlowModelParts parts = Parts();
  WindowRequest window = MakeScene(30).request;
  window.controls = spec.controls;
  const Eigen::MatrixXf features = DescribeWindow(parts.skeleton, parts.config, parts.prior, window,
                                                  FlowWindow(parts.prior, window))
                                       .frames;
  ASSERT_EQ(features.rows(), FrameFeatures() + 6);
  const int begin = 1 + 6 + 5 + 2 * kBodyParts;
  EXPECT_EQ(features.col(kTau).segment(begin, 3), Eigen::Vector3f(2, 2, 3));

  nlohmann::ordered_json report;
  cli::WriteControls(heard, &report, toy::kRows);
  EXPECT_EQ(report["gaze"]["values"].size(), 6U);
  const auto known = cli::ReadControls<toy::ControlRequest>(report, "r.json", toy::kRows);
  EXPECT_EQ(known.gaze->values, asked.gaze->values);
  const auto later = cli::Delayed(known, -10);
  EXPECT_EQ(later.gaze->frames, (std::vector<int64_t>{0, 10}));
  EXPECT_EQ(later.gaze->values, (std::vector<double>{3, 2, 3, 5, 2, 3}));
}

// As any control does, it ends the transition under way where the frames are no longer frozen.
TEST_F(ToyControl, TakesEffectInTheMidstOfADance) {
  Timeline timeline({.granted = 30});
  ASSERT_TRUE(timeline.Planned());
  ASSERT_GT(timeline.Planned()->to, 30);
  ModelInfo model;
  Track track(model);
  const int64_t from = timeline.Frontier("controls");
  const auto changes = track.Set(Read(InProject(kGaze)), from, "controls", toy::kRows);
  EXPECT_TRUE(NoteChanges(changes, 0, from, &timeline).empty()) << "its last row still holds";
  timeline.GenerateUntil(60);
  EXPECT_EQ(timeline.Planned()->stop, 30);
}

TEST_F(ToyControl, HasAnOption) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / "toy_gaze.json";
  std::ofstream(path) << kGaze.dump();
  authoring::WrittenControls written;
  CLI::App command;
  cli::AddControlOptions(command, &written, toy::kRows);
  command.parse("--gaze " + path.string());
  EXPECT_EQ(Read(written).gaze->frames, (std::vector<int64_t>{0, 20}));
  ExpectError(ErrorCode::kInvalidArgument, "gaze: the model \"toy\" does not have this control",
              [&] { Read(written, {"root_path"}); });
  std::filesystem::remove(path);
}

TEST_F(ToyControl, ErrorsNameWhereItWasWritten) {
  const authoring::WrittenControls written =
      InProject({{"frames", {0, 20}}, {"values", {1, 2, 3}}});
  ExpectError(ErrorCode::kInvalidArgument, "p.json:controls.gaze: ", [&] { Read(written); });
  const Error refused(ErrorCode::kInvalidArgument, "controls[0].gaze.values[4]", "no");
  EXPECT_EQ(written.InTermsOf(refused).field(), "p.json:controls.gaze.values[4]");
}

}  // namespace choreo::toy_way_test
