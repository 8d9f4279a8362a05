#!/usr/bin/env bash
# Makes docs/films/choreo.webm, a film with sound about choreo, and docs/images/choreo.jpg, its still:
# pictures by choreo, captions and cuts by ffmpeg.
#   scripts/film.sh BIN_DIRECTORY OUT.webm
# The song is Carlos Viola Iborra's (docs/films/NOTICE): keep its notice with the film.
set -euo pipefail
(($# == 2)) || { echo "film.sh: BIN_DIRECTORY and OUT.webm are wanted" >&2; exit 2; }
choreo=$1/choreo
examples=$(realpath "$(dirname "$0")/../examples")
song="/usr/share/games/fretsonfire/data/songs/sectoid/Escape from chaosland/song.ogg"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT

# dance NAME START SECONDS OPTIONS...: a part of the song.
dance() {
  "$choreo" dance "$song" --song-start "$2" --seconds "$3" --out "$scratch/$1.npz" --report "$scratch/$1.json" "${@:4}"
}
# picture NAME WIDTHxHEIGHT: a dance without sound.
picture() {
  "$choreo" render "$scratch/$1.npz" --report "$scratch/$1.json" --song none --video "$scratch/$1.mp4" --size "$2"
}
# scene NUMBER CAPTION PICTURES...: one or more dances side by side, 640 x 360.
scene() {
  local inputs=() count=$(($# - 2)) caption=$scratch/caption$1.txt
  for name in "${@:3}"; do inputs+=(-i "$scratch/$name.mp4"); done
  printf '%s' "$2" > "$caption"
  local beside="[0:v]null[row]"
  ((count == 1)) || beside="hstack=inputs=${count}[row]"
  local text="drawtext=textfile=$caption:font='DejaVu Sans':fontsize=20:fontcolor=0x24292f:x=(w-text_w)/2:y=14"
  ffmpeg -v error -y "${inputs[@]}" -filter_complex "$beside;[row]scale=640:360,$text,format=yuv420p" -c:v libx264 -preset veryfast -crf 16 "$scratch/scene$1.mp4"
  echo "file 'scene$1.mp4'" >> "$scratch/scenes.txt"
}

# Cuts are on downbeats of the song, which plays through.
cuts=(0 24.922 33.811 42.7 51.589 60.478 69.367 78.256 87.145 96.034 104.923 113.812 122.701)
part() { awk "BEGIN {print ${cuts[$1 + 1]} - ${cuts[$1]}}"; }

dance keys 0 "$(part 0)" --seed 1 --keyframes "$examples/demo.json"
picture keys 640x360
scene 0 "A song and key poses in: each is hit on its frame" keys

for seed in 1 2 3; do
  dance seed$seed "${cuts[1]}" "$(part 1)" --keyframes none --seed $seed
  picture seed$seed 212x360
done
scene 1 "The same music, three seeds: three dances" seed1 seed2 seed3

dance path "${cuts[2]}" "$(part 2)" --keyframes none --path "$examples/path.json" --velocity left_arm=1.5
picture path 640x360
scene 2 "Led along a path, the left arm livelier" path

for style in salsa indian modern; do
  dance $style "${cuts[3]}" "$(part 3)" --model free --keyframes none --style $style
  picture $style 212x360
done
scene 3 "Styles asked of the model 'free': salsa, indian, modern" salsa indian modern

dance before "${cuts[4]}" "$(part 4)" --keyframes none
"$choreo" edit "$scratch/before.npz" --key high_kick --at 3.556 --key star_jump --at 6.222 --song "$song" --song-start "${cuts[4]}" \
  --report "$scratch/before.json" --out "$scratch/after.npz" --new-report "$scratch/after.json"
picture before 320x360
picture after 320x360
scene 4 "A kick and a jump put in later: the rest stays" before after

dance company "${cuts[5]}" "$(part 5)" --dancers "$examples/dancers.json"
"$choreo" render "$scratch"/company.*.npz --song none --video "$scratch/company.mp4" --size 640x360
scene 5 "Three dancers: one mirrored, one four counts later" company

dance plain "${cuts[6]}" "$(part 6)" --keyframes none
"$choreo" edit "$scratch/plain.npz" --key high_kick --at 3.556 --hit 3 --song "$song" --song-start "${cuts[6]}" --report "$scratch/plain.json" \
  --out "$scratch/hit.npz" --new-report "$scratch/hit.json"
"$choreo" edit "$scratch/plain.npz" --key dab --at 3.556 --hold 1.5 --song "$song" --song-start "${cuts[6]}" --report "$scratch/plain.json" \
  --out "$scratch/held.npz" --new-report "$scratch/held.json"
picture hit 320x360
picture held 320x360
scene 6 "A key can be hit hard, or held" hit held

echo '{"keyframes": [{"id": "point", "time": 0.6, "pose": "disco_point"}, {"id": "kick", "time": 2.2, "pose": "kick"},
  {"id": "lunge", "time": 3.8, "pose": "lunge"}]}' > "$scratch/keys.json"
dance phrase "${cuts[7]}" "$(part 7)" --keyframes "$scratch/keys.json"
"$choreo" edit "$scratch/phrase.npz" --report "$scratch/phrase.json" --repeat 0 4.4 4.444 --mirror-phrase 4.444 8.8 \
  --out "$scratch/again.npz" --new-report "$scratch/again.json"
picture again 640x360
scene 7 "A phrase of keys, then the same phrase mirrored" again

for dynamics in 0 1; do
  dance dynamics$dynamics "${cuts[8]}" "$(part 8)" --keyframes none --music-dynamics $dynamics
  picture dynamics$dynamics 320x360
done
scene 8 "The music's loudness: not followed, followed fully" dynamics0 dynamics1

for tempo in half double; do
  dance $tempo "${cuts[9]}" "$(part 9)" --keyframes none --$tempo-time
  picture $tempo 320x360
done
scene 9 "The same beats in half time, in double time" half double

ffmpeg -v error -y -loop 1 -i "$(dirname "$0")/../docs/images/studio.jpg" -t "$(part 10)" -r 30 \
  -vf "scale=-2:300,pad=640:360:(ow-iw)/2:50:color=white" "$scratch/studio.mp4"
scene 10 "The studio, in the browser: drop a song, pull a pose" studio

dance bow "${cuts[11]}" "$(part 11)" --keyframes none --end bow
picture bow 640x360
scene 11 "Let it end with a bow" bow

ffmpeg -v error -y -f concat -i "$scratch/scenes.txt" -i "$song" -map 0:v -map 1:a -t "${cuts[-1]}" \
  -metadata comment="Song: Escape from chaosland, (c) 2006/2007 Carlos Viola Iborra, MIT licence" \
  -c:v libvpx-vp9 -crf 44 -b:v 0 -deadline good -cpu-used 4 -row-mt 1 -c:a libopus -b:a 64k "$2"
bytes=$(stat -c %s "$2")
((bytes <= 4 << 20)) || { echo "film.sh: $2 is $bytes bytes, more than 4 MiB" >&2; exit 1; }
ffmpeg -v error -y -ss 5.3 -i "$2" -frames:v 1 -q:v 6 "${2%.webm}.jpg"
