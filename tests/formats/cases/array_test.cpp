#include <zip.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "model/formats/amass_npz.h"
#include "model/motion/floor_clearance.h"
#include "tests/formats/cases/cases.h"
#include "tests/support/expect_error.h"
#include "tests/support/pickles.h"

namespace choreo::cases_test {

/// A body that steps, in SMPL's terms, by 20 frames; Z up as AMASS has it.
struct SmplArrays {
  Motion motion;  ///< ours
  std::vector<double> root, body, trans;

  explicit SmplArrays(int frames = 20) {
    motion.fps = 30;
    for (int frame = 0; frame < frames; ++frame) {
      Pose pose = RestPose(kSmpl);
      pose.root_position.x() = 0.05 * frame;
      pose.rotations.col(kSmpl.left_hip) << -0.02 * frame, 0, 0;
      pose.rotations.col(kSmpl.left_knee) << 0.03 * frame, 0, 0.1;
      pose.rotations.col(kSmpl.Find("head")) << 0, 0.5, 0.2;
      motion.frames.push_back(pose);
      const Pose amass = ToAmass(pose);
      root.insert(root.end(), amass.rotations.data(), amass.rotations.data() + 3);
      body.insert(body.end(), amass.rotations.data() + 3, amass.rotations.data() + 66);
      trans.insert(trans.end(), amass.root_position.begin(), amass.root_position.end());
    }
  }
  int64_t frames() const { return std::ssize(motion.frames); }
  NpyArray Root() const { return {{frames(), 3}, root}; }
  NpyArray Body() const { return {{frames(), 63}, body}; }
  NpyArray Trans() const { return {{frames(), 3}, trans}; }
  // All 22 joints, `width` values each, as `state` has a rotation vector.
  std::vector<double> All(const std::function<std::vector<double>(Eigen::Vector3d)>& state,
                          int joints) const {
    std::vector<double> all;
    for (int64_t frame = 0; frame < frames(); ++frame) {
      for (int joint = 0; joint < joints; ++joint) {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();
        if (joint == 0)
          turn = Eigen::Map<const Eigen::Vector3d>(&root[3 * static_cast<size_t>(frame)]);
        if (joint > 0 && joint < 22) {
          turn = Eigen::Map<const Eigen::Vector3d>(
              &body[static_cast<size_t>(63 * frame + 3 * (joint - 1))]);
        }
        const std::vector<double> values = state(turn);
        all.insert(all.end(), values.begin(), values.end());
      }
    }
    return all;
  }
};

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

std::vector<double> AsMatrix(const Eigen::Vector3d& turn) {
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> m = ExpMap(turn);
  return {m.data(), m.data() + 9};
}
std::vector<double> AsRows(const Eigen::Vector3d& turn) {
  std::vector<double> m = AsMatrix(turn);
  m.resize(6);
  return m;
}
std::vector<double> AsColumns(const Eigen::Vector3d& turn) {
  const auto six = SixDFromMatrix(ExpMap(turn));
  return {six.begin(), six.end()};
}
std::vector<double> AsVector(const Eigen::Vector3d& turn) { return {turn.begin(), turn.end()}; }

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
  ExpectError(ErrorCode::kInvalidArgument, "a.npz: poses[0][0]: is no rotation matrix",
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
  EXPECT_TRUE(y_up.Says("taken as y up, not z")) << Said(y_up);
  EXPECT_LT(WorstJoint(smpl.motion, y_up.motion), 1e-6);
  EXPECT_TRUE(ReadNpz(file(true, 1), {.up = "y"}).notes.empty());
  const Read centimetres = ReadNpz(file(false, 0.01));
  EXPECT_TRUE(centimetres.Says("taken as centimetres")) << Said(centimetres);
  EXPECT_LT(WorstJoint(smpl.motion, centimetres.motion), 1e-6);
  EXPECT_LT(WorstJoint(smpl.motion, ReadNpz(file(false, 0.5), {.scale = 0.5}).motion), 1e-6);
}

// Rows as networks and data sets of dance write them: what a turn is stated as, how many are there,
// what stands before the place and after the turns.
TEST_F(CasesTest, ReadsCommonRowLayouts) {
  const SmplArrays smpl;
  struct Row {
    const char* says;
    int before, joints;
    std::vector<double> (*state)(const Eigen::Vector3d&);
    Eigen::Vector3d rest = SmplXRestPelvis();
    bool y_up = true;
  };
  for (const Row& row : std::vector<Row>{
           {"LODGE's 135 numbers a frame, at 30", 0, 22, AsRows},
           {"LODGE's 139 numbers", 4, 22, AsRows},
           {"LODGE's 139 numbers", 4, 22, AsColumns},
           {"EDGE's 151 numbers a frame, at 30", 4, 24, AsRows, {0, 0, 0}, false},
           {"FineDance's 315 numbers", 0, 52, AsRows},
           {"FineDance's 319 numbers", 4, 52, AsRows},
           {"AIST++'s 219 numbers a frame, at 60", 0, 24, AsMatrix, SmplRestPelvis()},
           {"AIST++'s 225 numbers", 6, 24, AsMatrix, SmplRestPelvis()},
       }) {
    SCOPED_TRACE(row.says);
    std::vector<double> rows;
    for (const Pose& pose : smpl.motion.frames) {
      Pose stated = row.y_up ? pose : ToAmass(pose);
      if (!row.y_up) stated.root_position += SmplRestPelvis();
      rows.insert(rows.end(), static_cast<size_t>(row.before), 0.25);
      for (const double value : Eigen::Vector3d(stated.root_position - row.rest))
        rows.push_back(value);
      for (int joint = 0; joint < row.joints; ++joint) {
        Eigen::Vector3d turn = Eigen::Vector3d::Zero();
        if (joint < 22) turn = stated.rotations.col(joint);
        const std::vector<double> values = row.state(turn);
        rows.insert(rows.end(), values.begin(), values.end());
      }
    }
    const int64_t width = std::ssize(rows) / smpl.frames();
    const Read read = ReadBytes("a.npy", SerializeNpy({{smpl.frames(), width}, rows}));
    EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
    EXPECT_EQ(read.notes.size(), 1U) << Said(read);
    EXPECT_TRUE(read.Says(std::string("taken as ") + row.says)) << Said(read);
    const Read batch =
        ReadBytes("a.npy", SerializeNpy({{1, smpl.frames(), width}, rows}), {.fps = 25});
    EXPECT_EQ(batch.motion.fps, 25);
    EXPECT_LT(WorstJoint(smpl.motion, batch.motion), 1e-6);
    // As a network sees them: no rotations, nor read as some.
    for (size_t i = 0; i < rows.size(); ++i) rows[i] = (rows[i] - 0.1) * 3;
    ExpectError(ErrorCode::kInvalidArgument, "a.npy: [:, ", [&] {
      ReadBytes("a.npy", SerializeNpy({{smpl.frames(), width}, rows}));
    });
  }
}

TEST_F(CasesTest, MotionXsRows) {
  const SmplArrays smpl;
  std::vector<double> rows;
  for (const Pose& pose : smpl.motion.frames) {
    rows.insert(rows.end(), pose.rotations.data(), pose.rotations.data() + 66);
    rows.insert(rows.end(), 309 - 66, 0.2);
    for (const double value : Eigen::Vector3d(pose.root_position - SmplXRestPelvis()))
      rows.push_back(value);
    rows.insert(rows.end(), 10, 0.0);
  }
  const Read read = ReadBytes("a.npy", SerializeNpy({{smpl.frames(), 322}, rows}));
  EXPECT_LT(WorstJoint(smpl.motion, read.motion), 1e-6);
  EXPECT_TRUE(read.Says("taken as Motion-X's 322 numbers a frame, at 30")) << Said(read);
  for (size_t i = 312; i < rows.size(); i += 322) rows[i] = 2, rows[i - 2] -= 0.1;
  EXPECT_TRUE(ReadBytes("a.npy", SerializeNpy({{smpl.frames(), 322}, rows}))
                  .Says("its betas are another body's"));
}

TEST_F(CasesTest, HumanMl3dsRows) {
  const SmplArrays smpl;
  const auto yaw = [](int64_t frame) -> Eigen::Matrix3d { return About(0, 1, 0, 7.0 * frame); };
  const auto root = [&](int64_t frame) -> Eigen::Vector3d {
    return smpl.motion.frames[static_cast<size_t>(frame)].root_position;
  };
  std::vector<double> rows;
  for (int64_t frame = 0; frame + 1 < smpl.frames(); ++frame) {
    const Eigen::Vector3d way = yaw(frame + 1) * (root(frame + 1) - root(frame));
    const Eigen::Matrix3Xd joints =
        JointPositions(kSmpl, smpl.motion.frames[static_cast<size_t>(frame)]);
    rows.insert(rows.end(), {3.5 / kDegrees, way.x(), way.z(), root(frame).y()});
    for (Eigen::Index joint = 1; joint < 22; ++joint) {
      const Eigen::Vector3d seen =
          yaw(frame) * (joints.col(joint) - Eigen::Vector3d(root(frame).x(), 0, root(frame).z()));
      rows.insert(rows.end(), seen.begin(), seen.end());
    }
    rows.insert(rows.end(), 263 - 4 - 63, 0.1);
  }
  const NpyArray array{{smpl.frames() - 1, 263}, rows};
  const Read read = ReadBytes("a.npy", SerializeNpy(array));
  EXPECT_EQ(read.motion.fps, 20);
  EXPECT_TRUE(read.Says("taken as HumanML3D's 263 numbers a frame, at 20")) << Said(read);
  EXPECT_TRUE(read.Says("joints alone do not say"));
  for (const size_t frame : {0U, 9U, 18U}) {
    const Eigen::Matrix3Xd off = JointPositions(kSmpl, read.motion.frames[frame]) -
                                 JointPositions(kSmpl, smpl.motion.frames[frame]);
    EXPECT_LT(off.leftCols(22).colwise().norm().maxCoeff(), 0.03) << frame;
  }
  for (double& value : rows) value *= 3;
  for (size_t i = 0; i < rows.size(); ++i) rows[i] += static_cast<double>(i * i % 7);
  ExpectError(ErrorCode::kInvalidArgument, "are they normalised?", [&] {
    ReadBytes("a.npy", SerializeNpy({array.shape, rows}));
  });
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

// Objects among arrays are read where they are numbers or dicts; what a file is, and has, is said.
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
  ExpectError(ErrorCode::kInvalidArgument, "a.npz: fps: 0 frames a second are none; --fps says",
              [&] { ReadNpz(other); });
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
  ExpectError(ErrorCode::kInvalidArgument, "joints: are no places", [&] { ReadNpz(npz); });
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
TEST_F(CasesTest, ClimbingIsNoLying) {
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
  EXPECT_TRUE(read.Says("taken as y up, not z")) << Said(read);
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
