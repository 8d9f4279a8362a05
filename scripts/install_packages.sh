#!/usr/bin/env bash
# Installs the Debian 12 packages that this project needs, which are listed only here.
#
#   scripts/install_packages.sh [GROUP...]     groups: build run demo video test bench lint browser blender fuzz verify; default: build run demo video test
#
# Run as root or with sudo. Quick if everything is installed: asks dpkg first, and apt only for missing packages.
set -euo pipefail

# To compile everything.
build=(
  cmake ninja-build g++ pkg-config ccache git
  libtorch-dev libopenblas0-pthread
  libgrpc++-dev protobuf-compiler protobuf-compiler-grpc libprotobuf-dev libssl-dev
  libeigen3-dev nlohmann-json3-dev libcli11-dev libspdlog-dev libtomlplusplus-dev
  libboost-dev prometheus-cpp-dev libasound2-dev liblo-dev
  libsndfile1-dev libflac-dev libvorbis-dev libopusfile-dev libmpg123-dev libzip-dev libxxhash-dev libcairo2-dev libtinygltf-dev
  libgtest-dev libgmock-dev libbenchmark-dev libdnnl-dev
)
# To run programs compiled elsewhere. Debian's LibTorch brings only a slow BLAS: libopenblas0-pthread replaces it.
run=(
  libtorch1.13 libopenblas0-pthread libgrpc++1.51 libprotobuf32
  libasound2 liblo7 libspdlog1.10 libprometheus-cpp-core1.0 libssl3 libsndfile1 libflac12 libvorbisfile3 libopusfile0 libmpg123-0 libzip4 libxxhash0 libcairo2 libtinygltf2d
)
# Free songs to dance to.
demo=(fretsonfire-songs-sectoid)
# For `choreo render --video`.
video=(ffmpeg)
# An independent reader of our files, and the needs of the examples in other languages and web pages (which are tests, too).
test=(python3-numpy python3-grpcio python3-protobuf python3-pip python3-setuptools python3-wheel nodejs npm openssl shellcheck)
# For the comparisons of `make bench`.
bench=(python3-torch python3-numpy)
lint=(clang-format clang-tidy)
# To test the studio in a headless browser.
browser=(chromium nodejs npm)
# To open our files in Blender, and to test its add-on.
blender=(blender)
# libFuzzer with its compiler.
fuzz=(clang-14 libclang-rt-14-dev libfuzzer-14-dev)
# To build the container without a container engine, and to draw the dashboard.
verify=(buildah debootstrap prometheus python3-matplotlib)

groups=("$@")
[[ ${#groups[@]} -gt 0 ]] || groups=(build run demo video test)

wanted=()
for group in "${groups[@]}"; do
  case $group in
    build) wanted+=("${build[@]}") ;;
    run) wanted+=("${run[@]}") ;;
    demo) wanted+=("${demo[@]}") ;;
    video) wanted+=("${video[@]}") ;;
    test) wanted+=("${test[@]}") ;;
    bench) wanted+=("${bench[@]}") ;;
    lint) wanted+=("${lint[@]}") ;;
    browser) wanted+=("${browser[@]}") ;;
    blender) wanted+=("${blender[@]}") ;;
    fuzz) wanted+=("${fuzz[@]}") ;;
    verify) wanted+=("${verify[@]}") ;;
    *) echo "install_packages.sh: unknown group '$group' (build run demo video test bench lint browser blender fuzz verify)" >&2; exit 2 ;;
  esac
done

if ! command -v dpkg-query >/dev/null; then
  echo "install_packages.sh: this is not Debian; install by hand: ${wanted[*]}" >&2
  exit 1
fi

# Installed packages and what they provide: for example, a Node.js from elsewhere brings its own npm.
installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}, ${Provides}\n' |
  sed -n 's/^installed //p' | tr ',' '\n' | sed 's/(.*//; s/ //g')
missing=()
for package in "${wanted[@]}"; do
  grep -qxF -- "$package" <<<"$installed" || missing+=("$package")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "install_packages.sh: must run as root or with sudo to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${#missing[@]} packages: ${missing[*]}"
install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends)
# Package lists may be old or missing: refresh them once if the first attempt fails.
if ! "${install[@]}" "${missing[@]}" >/dev/null 2>&1; then
  "${as_root[@]}" apt-get update -qq
  "${install[@]}" "${missing[@]}" >/dev/null
fi
