#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>

#include "client/authoring/keys/key_faults.h"
#include "client/authoring/keys/key_file.h"
#include "client/authoring/keys/pose_file.h"
#include "client/authoring/keys/pose_library.h"
#include "client/cli/commands/commands.h"
#include "client/cli/commands/pose_recipe.h"
#include "client/cli/options/options.h"
#include "client/cli/options/output_file.h"
#include "client/cli/options/placing_options.h"
#include "model/core/error.h"
#include "model/core/files/atomic_file.h"
#include "model/core/joined.h"
#include "model/draw/contact_sheet.h"
#include "model/motion/kinematics/canonical.h"
#include "model/motion/kinematics/joint_angles.h"
#include "model/motion/pose/pose_faults.h"

namespace choreo::cli {
namespace {

struct PoseOptions {
  PoseRecipe recipe;
  std::string photo;
  double at_s = 0;
  std::optional<double> hold_s, hit;
  std::string hands;
  std::string description;
  std::vector<std::string> tags;
  std::string out;
  std::string png;
  bool list = false;
};

const Skeleton& Body() { return Skeleton::Smpl24(); }

struct SheetSize {
  int columns;
  int tile_width, tile_height;  // pixels
};

/// Draws a sheet of poses with captions instead of times.
void Draw(const std::vector<Pose>& poses, const std::vector<std::string>& captions,
          const std::string& title, const SheetSize& size, const std::string& png) {
  ContactSheetOptions sheet;
  sheet.title = title;
  sheet.frames = static_cast<int>(poses.size());
  sheet.captions = captions;
  sheet.columns = size.columns;
  sheet.tile_width = size.tile_width;
  sheet.tile_height = size.tile_height;
  DrawContactSheet({{Body(), {.fps = 1, .frames = poses}}}, sheet, png);
}

/// Draws a pose from three sides: three quarters from its front, from its left, and from behind.
void DrawAround(const client::KeyPose& key, const std::string& png) {
  const GroundFrame place = GroundFrame::Of(key.pose);
  std::vector<Pose> sides;
  for (const double turn : {0.0, -M_PI / 2, M_PI}) {
    GroundFrame turned;
    turned.heading = turn;
    sides.push_back(turned.ToWorld(place.ToLocal(key.pose)));
  }
  Draw(sides, {"front", "left", "back"}, key.id, {3, 300, 360}, png);
}

void PrintAngles(const client::KeyPose& key) {
  const Eigen::Vector3d& root = key.pose.root_position;
  std::printf("%s: %s at %.2f, %.2f, %.2f m; degrees:\n", key.id.c_str(),
              Body().joint_names[0].c_str(), root.x(), root.y(), root.z());
  for (int joint = 0; joint < Body().joints(); ++joint) {
    std::string line = Body().joint_names[static_cast<size_t>(joint)];
    char separator = '=';
    for (const double degrees : DegreesFromRotation(Body(), joint, key.pose.rotations.col(joint))) {
      char number[32];
      std::snprintf(number, sizeof(number), "%c%.0f", separator, std::round(degrees) + 0.0);
      line += number;
      separator = ',';
    }
    std::puts(line.c_str());
  }
}

void List(const PoseOptions& options) {
  const auto has_tags = [&](const authoring::LibraryPose& pose) {
    return std::ranges::all_of(options.tags, [&](const std::string& tag) {
      return std::ranges::find(pose.tags, tag) != pose.tags.end();
    });
  };
  std::vector<Pose> poses;
  std::vector<std::string> names;
  for (const authoring::LibraryPose& pose : authoring::PoseLibrary()) {
    if (!has_tags(pose)) continue;
    poses.push_back(pose.pose);
    names.push_back(pose.id);
    std::printf("%-18s %s  [%s]\n", pose.id.c_str(), pose.description.c_str(),
                Joined(pose.tags).c_str());
  }
  if (poses.empty()) {
    throw Error(ErrorCode::kNotFound, "--tag",
                "no pose of the library is " + Joined(options.tags) + "; tags are " +
                    Joined(authoring::PoseTags()));
  }
  if (options.png.empty()) return;
  Draw(poses, names, "", {8, 150, 180}, options.png);
}

void Run(const PoseOptions& options) {
  if (!options.photo.empty()) {
    throw InvalidArgument("--from-photo",
                          "photos are read in the browser: open `choreo studio` and drop " +
                              options.photo +
                              " on its page; for what another program found in it there are "
                              "--from-landmarks and --from-smpl");
  }
  if (!options.png.empty()) RequireExtension("--png", options.png, {".png"});
  if (!options.out.empty()) RequireExtension("--out", options.out, {".json"});
  RequireOutputs({{"--out", options.out}, {"--png", options.png}}, {});
  if (options.list) return List(options);
  authoring::NamedPose made = MakePose(options.recipe, Body());
  client::KeyPose& key = made.key;
  for (const std::string& fault : PoseFaults(Body(), key.pose, key.mask))
    std::cerr << "warning: " << fault << '\n';
  if (!options.out.empty()) {
    const double hold_s = options.hold_s.value_or(authoring::HeldSeconds(made));
    key.id = std::filesystem::path(options.out).stem().string();
    key.time_s = options.at_s;
    key.frame.reset();
    if (!options.hands.empty()) key.hands = FindHandPose(options.hands);
    if (options.hit) key.hit = options.hit;
    authoring::RefuseHeldInAir(key, hold_s, "--hold", Body());
    WriteFile(options.out,
              authoring::PoseFileText({key, options.description, options.tags, hold_s}, Body()));
  }
  if (!options.png.empty()) DrawAround(key, options.png);
  if (options.out.empty() && options.png.empty()) PrintAngles(key);
  for (const std::string& written : {options.out, options.png})
    if (!written.empty()) std::cout << written << std::endl;
}

}  // namespace

void AddPoseCommand(CLI::App& program) {
  auto options = std::make_shared<PoseOptions>();
  PoseRecipe& recipe = options->recipe;
  CLI::App* command =
      program.add_subcommand("pose",
                             "Make a key pose from another one, with joints in degrees, and hands "
                             "and feet at places.\nOptions apply in the order below. Without --out "
                             "and --png the joints are printed, in degrees.");
  CLI::Option* from =
      command
          ->add_option(
              "--from", recipe.from,
              "A pose of the library (--list), rest (arms out to the sides), a key file, or "
              "MOTION@SECOND.")
          ->capture_default_str();
  CLI::Option* landmarks =
      command
          ->add_option("--from-landmarks", recipe.from_landmarks,
                       "FILE.json of the 33 world landmarks that MediaPipe Pose found in a photo.")
          ->excludes(from);
  command
      ->add_option("--from-photo", options->photo,
                   "Not read here: the page of `choreo studio` reads photos.")
      ->excludes(from);
  command
      ->add_option("--from-smpl", recipe.from_smpl,
                   "FILE.json or FILE.npz with the SMPL pose that an estimator found in a photo: "
                   "24 axis-angle vectors or matrices.")
      ->excludes(from)
      ->excludes(landmarks);
  AddRepeated(*command, "--set", recipe.set,
              "JOINT=DEGREES. Knees and elbows take one number, their bend. Other joints take "
              "three, as in left_shoulder=10,0,-45: turns about x (to the dancer's left), y (up) "
              "and z (forward), in this order. Repeatable.");
  CLI::Option* ground = command->add_flag_callback(
      "--ground", [options] { options->recipe.height_m = 0; },
      "Put the lowest point of the body on the floor.");
  command
      ->add_option("--lift", recipe.height_m,
                   "Metres of that point above the floor, for a jump. Not with --ground.")
      ->check(NumberFrom(0, kMaxJumpHeight))
      ->excludes(ground);
  AddRepeated(*command, "--reach", recipe.reach,
              "JOINT=X,Y,Z: pull a joint to a place, metres, as in right_hand=0.3,1.6,0.2. The "
              "other feet stay where they are; a foot's height is its sole's. Trunk and arms "
              "follow the pelvis. Repeatable.");
  command->add_flag("--keep-hands", recipe.keeps_hands,
                    "Keep hands and head near their places if --reach moves the pelvis.");
  command->add_flag("--mirror", recipe.mirror, "Exchange left and right.");
  AddPlacing(*command, recipe.placing, "the pose");
  command->add_option("--at", options->at_s, "Second of the dance for the written key.")
      ->check(CLI::Validator(
          [](const std::string& text) -> std::string {
            if (!text.ends_with('c')) return {};
            return text + " is a count, and pose knows no song: say seconds";
          },
          ""))
      ->check(TimeInSeconds())
      ->capture_default_str();
  CLI::Option* hold =
      command
          ->add_option("--hold", options->hold_s,
                       "Seconds for which the written key's pose is held.")
          ->check(NumberFrom(authoring::kMinHoldSeconds, authoring::kMaxHoldSeconds));
  AddHit(*command, options->hit, "the written key is");
  AddHands(*command, options->hands,
           "Hands in the written key, for characters with fingers (choreo convert)");
  command->add_option("--description", options->description, "Description to write with the pose.");
  AddRepeated(*command, "--tag", options->tags,
              "Tag to write with the pose; with --list, only poses with this tag. Repeatable.");
  CLI::Option* out = command->add_option("-o,--out", options->out, "Key file to write, FILE.json.");
  hold->needs(out);
  command->get_option("--hit")->needs(out);
  command->add_option("--png", options->png, "Picture to write: the pose from three sides.");
  command->add_flag("--list", options->list,
                    "Show the poses of the library instead; as a picture with --png.");
  command->callback([options] { Run(*options); });
}

}  // namespace choreo::cli
