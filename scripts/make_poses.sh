#!/usr/bin/env bash
# Makes those library poses, client/poses/*.json, that are recipes of joints in degrees and places of hands and feet.
#   scripts/make_poses.sh [FOLDER]
# `choreo` is build/release/bin/choreo, or $CHOREO.
set -euo pipefail
cd "$(dirname "$0")/.."
choreo=${CHOREO:-build/release/bin/choreo}
folder=${1:-client/poses}

# [lift=METRES] pose NAME TAG[,TAG] DESCRIPTION [FROM] JOINT=DEGREES... [at JOINT=PLACE...]: FROM is a pose of the folder or the library. On the floor, or above it.
pose() {
  local name=$1 tag=$2 description=$3 option=--set
  shift 3
  local arguments=() tags=() one
  for one in ${tag//,/ }; do tags+=(--tag "$one"); done
  if [[ $1 != *=* ]]; then
    if [[ -e $folder/$1.json ]]; then arguments+=(--from "$folder/$1.json"); else arguments+=(--from "$1"); fi
    shift
  fi
  arguments+=(--lift "${lift:-0}" --keep-hands)
  for word in "$@"; do
    if [[ $word == at ]]; then option=--reach; else arguments+=("$option" "$word"); fi
  done
  "$choreo" pose "${arguments[@]}" --description "$description" "${tags[@]}" --out "$folder/$name.json"
}

# Standing.
pose stand standing "At ease, arms at the sides." \
  left_shoulder=0,0,-72 right_shoulder=0,0,72 left_elbow=18 right_elbow=18 left_hip=0,8,4 right_hip=0,-8,-4
pose salute standing "Upright, right hand at the brow." stand \
  right_shoulder=0,0,-5 right_elbow=140 head=-4,0,0 at right_hand=-0.1,1.6,0.16
pose guard standing "Fists before the chin, left foot ahead, knees soft." stand \
  pelvis=6,-20,0 spine2=10,0,0 at left_foot=0.12,0,0.22 right_foot=-0.2,0,-0.12 pelvis=0,0.86,0 left_hand=0.12,1.36,0.34 right_hand=-0.08,1.34,0.24
pose dab standing "Face in the crook of the left arm, right arm out." stand \
  spine2=4,12,-12 neck=25,15,0 head=25,20,0 left_shoulder=0,-70,25 left_elbow=110 right_shoulder=0,25,-30 right_elbow=0
pose egyptian standing "One hand ahead, one behind, elbows high." stand \
  spine2=0,35,0 head=0,40,0 left_shoulder=-80,-10,10 left_elbow=95 right_shoulder=70,10,0 right_elbow=85 left_wrist=0,-60,0 right_wrist=0,-60,0
pose robot standing "Right forearm up, left forearm down, all corners square." stand \
  left_shoulder=90,0,5 left_elbow=90 right_shoulder=-90,0,-5 right_elbow=90 head=0,-25,0
pose muscles standing "Both arms bent up, fists by the ears." stand \
  left_shoulder=-85,0,15 right_shoulder=-85,0,-15 left_elbow=110 right_elbow=110 spine2=-8,0,0 left_hip=0,15,20 right_hip=0,-15,-20
pose arms_crossed standing "Arms folded, chin up, legs apart." stand \
  left_hip=0,12,12 right_hip=0,-12,-12 head=-10,0,0 spine1=-4,0,0 at left_hand=-0.17,1.22,0.2 right_hand=0.17,1.27,0.17
pose hands_on_head standing "Hands behind the head, elbows wide." stand \
  left_shoulder=-60,0,35 right_shoulder=-60,0,-35 left_elbow=130 right_elbow=130 at left_hand=0.05,1.62,-0.12 right_hand=-0.05,1.6,-0.12
pose blow_kiss standing "A kiss from the right hand, weight on the left leg." contrapposto \
  head=0,-15,5 at right_hand=-0.1,1.5,0.3
pose bow standing,ending "Bent deeply from the hips, arms swept back." stand \
  pelvis=70,0,0 left_hip=-70,8,4 right_hip=-70,-8,-4 spine2=20,0,0 neck=20,0,0 left_shoulder=0,40,-50 right_shoulder=0,-40,50 at pelvis=0,0.9,-0.16
pose curtsey standing,ending "Right leg crossed behind, both knees bent, skirts held." stand \
  left_shoulder=0,0,-45 right_shoulder=0,0,45 head=15,10,0 at right_foot=0.2,0,-0.4 left_foot=0.08,0,0.12 pelvis=0.06,0.72,-0.08
pose limbo standing "Leaning far back, knees bent, arms wide." stand \
  left_shoulder=0,10,-10 right_shoulder=0,-10,10 spine1=-18,0,0 spine2=-16,0,0 spine3=-10,0,0 left_hip=0,12,16 right_hip=0,-12,-16 at pelvis=0,0.76,0.18
pose twist standing "Knees bent, hips one way, arms the other." stand \
  spine1=0,-18,0 spine2=0,-22,0 left_shoulder=0,-50,-40 right_shoulder=0,-35,55 left_elbow=80 right_elbow=85 pelvis=8,30,0 at pelvis=0,0.76,-0.03
pose body_roll standing "Chest thrown forward, arms hanging back." stand \
  spine1=16,0,0 spine2=-30,0,0 spine3=-24,0,0 neck=-24,0,0 left_shoulder=0,62,-50 right_shoulder=0,-62,50 at pelvis=0,0.8,-0.04
pose releve standing "On the balls of both feet, arms round in front." stand \
  left_ankle=45,0,0 right_ankle=45,0,0 left_foot=-45,0,0 right_foot=-45,0,0 left_hip=0,20,0 right_hip=0,-20,0 at left_hand=0.1,1.1,0.42 right_hand=-0.1,1.1,0.42
pose tree standing "On the right leg, left sole against its knee, palms overhead." stand \
  left_hip=-40,60,55 left_knee=120 left_shoulder=-30,0,78 right_shoulder=-30,0,-78 left_elbow=30 right_elbow=30 at left_foot=-0.06,0.42,0.05 left_hand=0.02,1.95,0.02 right_hand=-0.02,1.95,0.02 pelvis=-0.06,0.93,0
pose attitude standing "On the left leg, right leg bent behind, right arm up." stand \
  pelvis=18,0,0 left_hip=-18,8,0 right_hip=58,-30,-22 right_knee=75 right_ankle=45,0,0 spine2=-18,0,0 left_shoulder=0,0,5 right_shoulder=-30,20,-65 right_elbow=35 at pelvis=0.07,0.95,-0.03
pose high_kick standing "On the right leg, left foot as high as the head." stand \
  left_hip=-125,0,10 left_knee=5 left_ankle=40,0,0 pelvis=-10,0,0 right_hip=12,-15,0 left_shoulder=0,-20,15 right_shoulder=0,20,-20 at pelvis=-0.07,0.95,-0.06
pose side_kick standing "Leaning over the right leg, left leg straight out to the side." stand \
  pelvis=0,0,35 left_hip=0,0,60 right_hip=0,-8,-42 left_ankle=30,0,0 spine2=0,0,-8 left_shoulder=0,-30,-30 left_elbow=60 right_shoulder=-30,40,30 right_elbow=100
pose air_guitar standing "Leaning back over the strings, left arm along the neck." stand \
  left_hip=0,15,14 right_hip=0,-10,-14 spine1=-8,0,-4 spine2=-8,0,-4 head=10,-10,0 at pelvis=0,0.8,0.05 left_foot=0.3,0,0.12 right_foot=-0.28,0,-0.08 left_hand=0.5,1.35,0.26 right_hand=-0.1,0.98,0.3

pose crouch standing "Low on both feet, hands between the knees." stand \
  pelvis=14,0,0 spine2=12,0,0 neck=-18,0,0 left_hip=-85,26,20 right_hip=-85,-26,-20 left_knee=121 right_knee=125 left_ankle=-27,0,0 right_ankle=-33,0,0 \
  at left_hand=0.08,0.35,0.34 right_hand=-0.08,0.35,0.34

# Travelling: in the middle of a step.
pose walk travelling "A step with the left leg, arms swinging." stand \
  left_shoulder=0,28,-72 right_shoulder=0,32,72 left_hip=-28,4,2 left_knee=6 left_ankle=-12,0,0 right_hip=18,-4,-2 right_knee=18 right_ankle=26,0,0 right_foot=-36,0,0
pose strut travelling "A long step, right shoulder ahead, chin up." stand \
  pelvis=0,25,0 spine2=-6,-40,0 neck=0,15,0 head=-8,0,0 left_shoulder=0,35,-60 right_shoulder=0,40,60 right_elbow=55 left_hip=-34,4,2 left_knee=10 left_ankle=-10,0,0 right_hip=24,-4,-2 right_knee=16 right_ankle=30,0,0 right_foot=-42,0,0
pose run travelling "At full stride, right knee up, elbows bent." stand \
  pelvis=12,0,0 left_hip=10,0,2 left_knee=14 left_ankle=38,0,0 left_foot=-34,0,0 right_hip=-88,0,0 right_knee=105 left_shoulder=0,-45,-66 left_elbow=95 right_shoulder=0,-50,66 right_elbow=90
pose march travelling "Left knee as high as the hip, right arm ahead." stand \
  left_hip=-92,0,4 left_knee=95 left_ankle=30,0,0 right_shoulder=0,80,72 right_elbow=10 left_shoulder=0,30,-72
pose lunge travelling "A deep step ahead onto the left leg, right arm pointing on." stand \
  right_shoulder=0,70,0 right_elbow=5 left_shoulder=0,30,-20 right_foot=-40,0,0 right_ankle=20,0,0 at left_foot=0.1,0,0.55 right_foot=-0.1,0,-0.5 pelvis=0,0.66,0.02
pose moonwalk travelling "Gliding back: right foot on its toes, left foot flat." stand \
  pelvis=8,0,0 spine1=-6,0,0 right_ankle=45,0,0 right_foot=-35,0,0 left_shoulder=0,30,-66 right_shoulder=0,40,66 left_elbow=30 right_elbow=45 \
  at left_foot=0.08,0,-0.34 right_foot=-0.08,0,0.08 pelvis=0,0.88,-0.08
pose grapevine travelling "Left foot crossed ahead of the right, arms out." stand \
  left_shoulder=0,-10,-12 right_shoulder=0,10,12 at left_foot=-0.24,0,0.24 right_foot=-0.08,0,0 pelvis=-0.1,0.84,0.08
pose skater travelling "Low on the left leg, right leg swept behind it, arms swung across." stand \
  pelvis=32,0,0 spine2=10,20,0 neck=-25,0,0 left_hip=-70,10,6 left_knee=75 right_hip=10,-20,28 right_knee=45 right_ankle=40,0,0 left_shoulder=0,40,-40 right_shoulder=0,70,40
pose charleston travelling "Right foot kicked back, left hand ahead, knees together." stand \
  pelvis=10,0,0 left_hip=-22,-6,0 left_knee=26 right_hip=-4,6,6 right_knee=85 right_ankle=30,0,0 left_shoulder=0,-60,-62 left_elbow=45 right_shoulder=0,-40,60 right_elbow=35

# In the air.
lift=0.4 pose star_jump jump "Arms and legs flung wide." \
  left_shoulder=0,0,40 right_shoulder=0,0,-40 left_hip=0,10,38 right_hip=0,-10,-38 left_ankle=35,0,0 right_ankle=35,0,0 head=-8,0,0
lift=0.55 pose tuck_jump jump "Both knees at the chest, arms round the shins." \
  pelvis=15,0,0 spine2=20,0,0 left_hip=-105,0,8 right_hip=-105,0,-8 left_knee=115 right_knee=115 left_ankle=30,0,0 right_ankle=30,0,0 left_shoulder=30,-60,-45 right_shoulder=30,60,45 left_elbow=45 right_elbow=45
lift=0.7 pose grand_jete jump "Split leap, left leg ahead, right arm to the front." \
  left_hip=-82,0,4 right_hip=70,-10,-6 left_ankle=40,0,0 right_ankle=45,0,0 spine1=-12,0,0 spine2=-8,0,0 left_shoulder=0,5,5 right_shoulder=0,75,-10 head=-6,0,0
lift=0.6 pose stag_leap jump "Left leg bent below, right leg stretched behind." \
  left_hip=-80,10,6 left_knee=125 left_ankle=40,0,0 right_hip=62,-10,-8 right_ankle=45,0,0 spine1=-12,0,0 left_shoulder=-30,0,70 right_shoulder=0,10,-10 left_elbow=20 head=-8,0,0
lift=0.15 pose pencil_jump jump "Straight up, feet pointed, hands overhead." \
  left_shoulder=-20,0,82 right_shoulder=-20,0,-82 left_elbow=12 right_elbow=12 left_ankle=45,0,0 right_ankle=45,0,0 left_foot=10,0,0 right_foot=10,0,0 head=-10,0,0
lift=0.7 pose side_leap jump "To the side: left leg out, right heel tucked, arms wide." \
  pelvis=0,0,18 spine2=0,0,-10 left_hip=0,10,50 right_hip=0,-10,20 left_knee=5 right_knee=85 left_ankle=40,0,0 right_ankle=40,0,0 left_shoulder=0,0,25 right_shoulder=0,0,15
lift=0.9 pose straddle_jump jump "Legs out to both sides at hip height, hands to the toes." \
  pelvis=20,0,0 spine2=22,0,0 left_hip=-98,48,0 right_hip=-98,-48,0 left_ankle=35,0,0 right_ankle=35,0,0 left_shoulder=0,-55,-25 right_shoulder=0,55,25
lift=0.7 pose arch_jump jump "Chest up, both feet kicked up behind." \
  spine1=-16,0,0 spine2=-14,0,0 neck=-14,0,0 left_hip=22,0,6 right_hip=22,0,-6 left_knee=85 right_knee=80 left_ankle=40,0,0 right_ankle=40,0,0 left_shoulder=0,20,55 right_shoulder=0,-20,-55

# On knees, seat or hands.
pose kneel floor "On the right knee, hands on the left." stand \
  left_hip=-98,8,6 left_knee=96 right_hip=4,-4,-2 right_knee=88 right_ankle=55,0,0 at left_hand=0.14,0.6,0.36 right_hand=0.02,0.62,0.36
pose praise floor "On both knees, leaning back, arms to the sky." \
  left_hip=6,0,8 right_hip=6,0,-8 left_knee=100 right_knee=100 left_ankle=55,0,0 right_ankle=55,0,0 spine1=-14,0,0 spine2=-14,0,0 neck=-14,0,0 left_shoulder=-20,0,62 right_shoulder=-20,0,-62 left_elbow=10 right_elbow=10
pose sit_long floor "Sitting, legs ahead, hands on the floor behind." \
  pelvis=-18,0,0 left_hip=-74,8,8 right_hip=-74,-8,-8 left_knee=2 right_knee=2 left_ankle=25,0,0 right_ankle=25,0,0 left_shoulder=0,30,-55 right_shoulder=0,-30,55 left_elbow=5 right_elbow=5 at left_hand=0.3,0.09,-0.34 right_hand=-0.3,0.09,-0.34
pose straddle_sit floor "Sitting with the legs wide, bent to the left foot." \
  left_hip=-91,48,0 right_hip=-91,-48,0 left_ankle=25,0,0 right_ankle=25,0,0 spine1=10,0,-14 spine2=12,0,-18 neck=10,0,-10 left_shoulder=0,-45,-35 left_elbow=35 right_shoulder=-30,0,-60 right_elbow=25
pose all_fours floor "On hands and knees, back hollow, head up." \
  pelvis=90,0,0 spine2=-16,0,0 spine3=-10,0,0 neck=-30,0,0 head=-20,0,0 left_hip=-88,0,4 right_hip=-88,0,-4 left_knee=88 right_knee=88 left_ankle=60,0,0 right_ankle=60,0,0 left_shoulder=0,-80,-5 right_shoulder=0,80,5 left_wrist=0,60,0 right_wrist=0,-60,0 \
  at left_hand=0.2,0.04,0.62 right_hand=-0.2,0.04,0.62
pose plank floor "Straight from heels to head on both hands." \
  pelvis=74,0,0 neck=-20,0,0 left_ankle=-20,0,0 right_ankle=-20,0,0 left_foot=-50,0,0 right_foot=-50,0,0 left_shoulder=0,-76,0 right_shoulder=0,76,0 left_wrist=0,65,0 right_wrist=0,-65,0
pose splits floor "Sitting in the splits, left leg ahead, arms up." \
  pelvis=14,0,0 left_hip=-103,0,2 right_hip=73,-15,-2 left_ankle=35,0,0 right_ankle=45,0,0 left_shoulder=-20,0,55 right_shoulder=-20,0,-55 left_elbow=10 right_elbow=10 spine1=-12,0,0 spine2=-8,0,0
pose crab floor "Chest to the sky on hands and feet." \
  pelvis=-78,0,0 left_hip=-14,0,10 right_hip=-14,0,-10 left_knee=92 right_knee=92 spine1=-6,0,0 neck=10,0,0 left_shoulder=0,80,0 right_shoulder=0,-80,0 left_wrist=0,-70,0 right_wrist=0,70,0
