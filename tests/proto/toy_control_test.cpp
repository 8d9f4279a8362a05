#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <google/protobuf/dynamic_message.h>
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <memory>

#include "proto/wire/control_messages.h"
#include "tests/support/expect_error.h"

// A control that the API does not have passes the wire with no code of its own.
namespace choreo::toy_wire_test {

struct Gaze {
  std::vector<int64_t> frames;
  std::vector<Eigen::Vector2d> points;
  std::vector<double> weights;
  std::vector<std::string> parts;
  std::string reference;

  static void VisitFields(auto& gaze, const auto& visit) {
    visit("frames", gaze.frames);
    visit("points", gaze.points);
    visit("weights", gaze.weights);
    visit("parts", gaze.parts);
    visit("reference", gaze.reference);
  }
};

class ToyOnTheWire : public ::testing::Test {
 protected:
  ToyOnTheWire() {
    google::protobuf::FileDescriptorProto file;
    EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
        R"(name: "toy.proto" syntax: "proto3" package: "toy"
           dependency: "choreo/v1/motion.proto"
           message_type {
             name: "Gaze"
             field { name: "frames" number: 1 label: LABEL_REPEATED type: TYPE_INT64 }
             field { name: "points" number: 2 label: LABEL_REPEATED type: TYPE_FLOAT }
             field { name: "weights" number: 3 label: LABEL_REPEATED type: TYPE_FLOAT }
             field { name: "parts" number: 4 label: LABEL_REPEATED type: TYPE_ENUM
                     type_name: ".choreo.v1.BodyPart" }
             field { name: "reference" number: 5 label: LABEL_OPTIONAL type: TYPE_STRING }
           })",
        &file));
    file.set_dependency(0, v1::BodyPart_descriptor()->file()->name());
    message_.reset(
        factory_.GetPrototype(pool_.BuildFile(file)->FindMessageTypeByName("Gaze"))->New());
  }

  google::protobuf::DescriptorPool pool_{google::protobuf::DescriptorPool::generated_pool()};
  google::protobuf::DynamicMessageFactory factory_{&pool_};
  std::unique_ptr<google::protobuf::Message> message_;
};

TEST_F(ToyOnTheWire, ComesBackAsItWent) {
  const Gaze gaze{{3, 9}, {{1, 2}, {3, 4.5}}, {0.5}, {"left_leg", "trunk"}, "calm"};
  Gaze::VisitFields(gaze, wire::FieldWriter(message_.get(), "gaze"));
  Gaze back;
  Gaze::VisitFields(back, wire::FieldReader(*message_, "controls.gaze"));
  EXPECT_EQ(back.frames, gaze.frames);
  EXPECT_EQ(back.points, gaze.points);
  EXPECT_EQ(back.weights, gaze.weights);
  EXPECT_EQ(back.parts, gaze.parts);
  EXPECT_EQ(back.reference, gaze.reference);
}

TEST_F(ToyOnTheWire, ErrorsNameItsFields) {
  Gaze gaze{.frames = {}, .points = {}, .weights = {}, .parts = {"tail"}, .reference = {}};
  ExpectError(ErrorCode::kInvalidArgument, "gaze.parts: \"tail\" is none of ",
              [&] { Gaze::VisitFields(gaze, wire::FieldWriter(message_.get(), "gaze")); });
  const auto* points = message_->GetDescriptor()->FindFieldByName("points");
  message_->GetReflection()->AddFloat(message_.get(), points, 1);
  ExpectError(ErrorCode::kInvalidArgument, "controls.gaze.points: 1 numbers, not two",
              [&] { Gaze::VisitFields(gaze, wire::FieldReader(*message_, "controls.gaze")); });
}

}  // namespace choreo::toy_wire_test
