#include <zip.h>

#include <map>
#include <string>
#include <vector>

#include "model/motion/floor/floor_clearance.h"
#include "tests/formats/cases/smpl_arrays.h"
#include "tests/support/expect_error.h"
#include "tests/support/pickles.h"

namespace choreo::cases_test {

// Another member: an array of objects, which is this pickle.
void AddObject(const std::filesystem::path& path, const std::string& key,
               const std::string& pickle) {
  int code = 0;
  zip_t* archive = zip_open(path.c_str(), 0, &code);
  ASSERT_NE(archive, nullptr);
  const std::string npy = JoinNpy({.descr = "|O", .shape = {}, .values = pickle});
  ASSERT_GE(zip_file_add(archive, (key + ".npy").c_str(),
                         zip_source_buffer(archive, npy.data(), npy.size(), 0), 0),
            0);
  ASSERT_EQ(zip_close(archive), 0);
}

TEST_F(CasesTest, ArraysOfEveryKind) {
  const SmplArrays smpl;
  struct Row {
    const char* name;
    std::map<std::string, NpyArray> arrays;
    std::string says = "";
  };
  const NpyArray rate{{}, std::vector<double>{30}};
  const int64_t f = smpl.frames();
  const std::vector<Row> rows = {
      {"split",
       {{"root_orient", smpl.Root()},
        {"pose_body", smpl.Body()},
        {"trans", smpl.Trans()},
        {"mocap_frame_rate", rate}}},
      {"smplx",
       {{"global_orient", smpl.Root()}, {"body_pose", smpl.Body()}, {"transl", smpl.Trans()}},
       "states no rate"},
      {"EMDB",
       {{"poses_root", smpl.Root()},
        {"poses_body", smpl.Body()},
        {"trans", smpl.Trans()},
        {"fps", rate}}},
      {"fps",
       {{"poses", {{f, 156}, smpl.All(AsVector, 52)}},
        {"trans", smpl.Trans()},
        {"fps", {{}, std::vector<int64_t>{30}}}}},
      {"22 joints",
       {{"poses", {{f, 22, 3}, smpl.All(AsVector, 22)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"no rate",
       {{"poses", {{f, 72}, smpl.All(AsVector, 24)}}, {"trans", smpl.Trans()}},
       "states no rate"},
      {"matrices",
       {{"poses", {{f, 24, 3, 3}, smpl.All(AsMatrix, 24)}},
        {"trans", smpl.Trans()},
        {"fps", rate}}},
      {"flat matrices",
       {{"poses", {{f, 216}, smpl.All(AsMatrix, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"6D",
       {{"poses", {{f, 24, 6}, smpl.All(AsRows, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"6D by columns",
       {{"poses", {{f, 144}, smpl.All(AsColumns, 24)}}, {"trans", smpl.Trans()}, {"fps", rate}}},
      {"a batch of one",
       {{"poses", {{1, f, 72}, smpl.All(AsVector, 24)}},
        {"trans", {{1, f, 3}, smpl.trans}},
        {"fps", rate}}},
  };
  for (const Row& row : rows) {
    for (const bool pickled : {false, true}) {
      SCOPED_TRACE(row.name + std::string(pickled ? " pkl" : " npz"));
      NpzArchive npz;
      for (const auto& [key, array] : row.arrays) npz.SetArray(key, array);
      if (pickled) WritePickle(folder_ / "a.pkl", row.arrays);
      const Read read = pickled ? ReadFile("a.pkl") : ReadNpz(npz);
      EXPECT_EQ(read.motion.fps, 30);
      EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
      EXPECT_EQ(read.notes.empty(), row.says.empty()) << Said(read);
      EXPECT_TRUE(row.says.empty() || read.Says(row.says)) << Said(read);
    }
  }
  NpzArchive npz;
  npz.SetArray("poses", {{f, 72}, smpl.All(AsVector, 24)});
  npz.SetArray("trans", smpl.Trans());
  EXPECT_EQ(ReadNpz(npz, {.fps = 50}).motion.fps, 50);
  npz.SetArray("poses", {{f, 24, 3, 3}, std::vector<double>(static_cast<size_t>(f) * 216, 0.5)});
  ExpectError(ErrorCode::kInvalidArgument, "a.npz: poses[0][0]: is not a rotation matrix",
              [&] { ReadNpz(npz); });
}

TEST_F(CasesTest, ArraysOfOtherAxesOrUnits) {
  const SmplArrays smpl;
  const auto file = [&](bool y_up, double unit) {
    std::vector<double> poses, trans;
    for (const Pose& pose : smpl.motion.frames) {
      const Pose stated = y_up ? pose : ToAmass(pose);
      poses.insert(poses.end(), stated.rotations.data(), stated.rotations.data() + 72);
      const Eigen::Vector3d place =
          (y_up ? Eigen::Vector3d(pose.root_position - SmplRestPelvis()) : stated.root_position);
      for (const double value : place) trans.push_back(value / unit);
    }
    NpzArchive npz;
    npz.SetArray("poses", {{smpl.frames(), 72}, poses});
    npz.SetArray("trans", {{smpl.frames(), 3}, trans});
    npz.SetArray("fps", {{}, std::vector<double>{30}});
    return npz;
  };
  const Read y_up = ReadNpz(file(true, 1));
  EXPECT_TRUE(y_up.Says("read as y up, not z")) << Said(y_up);
  EXPECT_LT(WorstJoint(smpl.motion, y_up.motion), 1e-6);
  EXPECT_TRUE(ReadNpz(file(true, 1), {.up = "y"}).notes.empty());
  const Read centimetres = ReadNpz(file(false, 0.01));
  EXPECT_TRUE(centimetres.Says("read as centimetres")) << Said(centimetres);
  EXPECT_LT(WorstJoint(smpl.motion, centimetres.motion), 1e-6);
  EXPECT_LT(WorstJoint(smpl.motion, ReadNpz(file(false, 0.5), {.scale = 0.5}).motion), 1e-6);
}

// {"pos", "q", "scale"}, and Bailando's places, which are flat.
TEST_F(CasesTest, ReadsCommonArrayNames) {
  const SmplArrays smpl;
  std::vector<double> pos, q, places;
  for (const Pose& pose : smpl.motion.frames) {
    for (const double value : Eigen::Vector3d(pose.root_position - SmplRestPelvis()))
      pos.push_back(93 * value);
    q.insert(q.end(), pose.rotations.data(), pose.rotations.data() + 72);
    const Eigen::Matrix3Xd at = JointPositions(kSmpl, pose);
    places.insert(places.end(), at.data(), at.data() + 72);
  }
  NpzArchive slices;
  slices.SetArray("pos", {{smpl.frames(), 3}, pos});
  slices.SetArray("q", {{smpl.frames(), 72}, q});
  slices.SetArray("scale", {{1}, std::vector<double>{93}});
  const Read read = ReadNpz(slices);
  EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
  EXPECT_TRUE(read.Says("states no rate")) << Said(read);
  NpzArchive bailando;
  bailando.SetArray("pred_position", {{smpl.frames(), 72}, places});
  const Motion placed = ReadNpz(bailando).motion;
  EXPECT_LT((JointPositions(kSmpl, placed.frames[9]) - JointPositions(kSmpl, smpl.motion.frames[9]))
                .colwise()
                .norm()
                .maxCoeff(),
            0.03);
}

// Reads objects among arrays if they are numbers or dicts; errors name the file and its arrays.
TEST_F(CasesTest, ObjectsAmongArrays) {
  using namespace std::string_literals;
  const SmplArrays smpl;
  const NpyArray poses{{smpl.frames(), 72}, smpl.All(AsVector, 24)};
  const auto with = [&](const std::string& key, const std::string& pickle) {
    NpzArchive npz;
    npz.SetArray("poses", poses);
    npz.SetArray("trans", smpl.Trans());
    npz.Write(folder_ / "a.npz");
    AddObject(folder_ / "a.npz", key, pickle);
    return ReadFile("a.npz");
  };
  // What numpy.savez writes of fps=numpy.array(50, dtype=object), and of a text.
  const Read read = with("fps", "\x80\x04K\x32."s);
  EXPECT_EQ(read.motion.fps, 50);
  EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
  EXPECT_EQ(with("info", "\x80\x04X\x02\0\0\0hi."s).motion.fps, 30);
  NpzArchive other;
  other.SetArray("rotmats", poses);
  ExpectError(ErrorCode::kInvalidArgument,
              "a.npz: has no array of rotations by a name that is known, poses, ",
              [&] { ReadNpz(other); });
  WritePickle(folder_ / "b.pkl", {{"rotmats", poses}});
  ExpectError(ErrorCode::kInvalidArgument, "b.pkl: has no array of rotations",
              [&] { ReadFile("b.pkl"); });
  other.SetArray("poses", poses);
  other.SetArray("fps", {{}, std::vector<double>{0}});
  ExpectError(ErrorCode::kInvalidArgument,
              "a.npz: fps: 0 frames a second are impossible; --fps sets", [&] { ReadNpz(other); });
  ExpectError(ErrorCode::kInvalidArgument, "c.pkl: is compressed, as joblib.dump does",
              [&] { ReadBytes("c.pkl", "x\x5e\xed"); });
  ExpectError(ErrorCode::kInvalidArgument, "c.pkl: is compressed: gunzip it",
              [&] { ReadBytes("c.pkl", "\x1f\x8b\x08"s); });
  ExpectError(ErrorCode::kInvalidArgument, "c.pkl: is a zip, as of torch.save",
              [&] { ReadBytes("c.pkl", "PK\x03\x04"s); });
}

// MDM's results: places of joints, people first and frames last.
TEST_F(CasesTest, ReadsPositionsWithFramesLast) {
  const SmplArrays smpl;
  std::vector<double> places(static_cast<size_t>(2 * 66 * smpl.frames()));
  for (int64_t frame = 0; frame < smpl.frames(); ++frame) {
    const Eigen::Matrix3Xd at =
        JointPositions(kSmpl, smpl.motion.frames[static_cast<size_t>(frame)]);
    for (int64_t value = 0; value < 66; ++value)
      places[static_cast<size_t>((66 + value) * smpl.frames() + frame)] = at.data()[value];
  }
  NpzArchive npz;
  npz.SetArray("motion", {{2, 22, 3, smpl.frames()}, places});
  ExpectError(ErrorCode::kInvalidArgument, "joints: are not places", [&] { ReadNpz(npz); });
  const Read read = ReadNpz(npz, {.body = "1"});
  ASSERT_EQ(read.motion.frames.size(), static_cast<size_t>(smpl.frames()));
  EXPECT_LT(
      (JointPositions(kSmpl, read.motion.frames[9]) - JointPositions(kSmpl, smpl.motion.frames[9]))
          .leftCols(22)
          .colwise()
          .norm()
          .maxCoeff(),
      0.03);
}

// Y up, and upright: up a staircase, away from where the floor was.
TEST_F(CasesTest, ClimbingIsNotLying) {
  const SmplArrays smpl(60);
  std::vector<double> poses, trans;
  for (size_t frame = 0; frame < 60; ++frame) {
    const Pose& pose = smpl.motion.frames[frame];
    poses.insert(poses.end(), pose.rotations.data(), pose.rotations.data() + 72);
    trans.insert(trans.end(), {0, 1.15 + 0.05 * static_cast<double>(frame), 0.9});
  }
  NpzArchive npz;
  npz.SetArray("poses", {{60, 72}, poses});
  npz.SetArray("trans", {{60, 3}, trans});
  npz.SetArray("fps", {{}, std::vector<double>{30}});
  const Read read = ReadNpz(npz);
  EXPECT_TRUE(read.Says("read as y up, not z")) << Said(read);
}

TEST_F(CasesTest, AnotherBodysFeetStandOnTheFloor) {
  SmplArrays smpl;
  for (size_t i = 2; i < smpl.trans.size(); i += 3) smpl.trans[i] -= 0.09;
  NpzArchive npz;
  npz.SetArray("poses", {{smpl.frames(), 72}, smpl.All(AsVector, 24)});
  npz.SetArray("trans", smpl.Trans());
  npz.SetArray("fps", {{}, std::vector<double>{30}});
  npz.SetArray("betas", {{10}, std::vector<double>(10, 1.5)});
  const Read read = ReadNpz(npz);
  EXPECT_TRUE(read.Says("betas are another body's")) << Said(read);
  EXPECT_NEAR(HeightAboveFloor(kSmpl, read.motion.frames[0]), 0, 0.01);
  npz.SetArray("betas", {{10}, std::vector<double>(10, 0.0)});
  EXPECT_TRUE(ReadNpz(npz).Says("its feet were under the floor"));
}

}  // namespace choreo::cases_test
