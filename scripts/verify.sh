#!/usr/bin/env bash
# Checks that take too long for `make test`: the figures of docs/results.md, a stranger's program that uses the installed client, training from
# recordings, the studio in a browser, Blender, npm's mannequin, the dashboard, faults, libFuzzer, the container, a build without the service,
# and the tests under sanitizers.
# CHOREO_RECORDINGS names the folder of recordings that figures are measured on (scripts/evaluate.sh). Without it nothing is measured,
# as the last line says.
#   scripts/verify.sh BUILD_DIRECTORY
set -euo pipefail
build=$(realpath "$1")
root=$(cd "$(dirname "$0")/.." && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cd "$root"

echo "== What docs/results.md quotes is what docs/figures say"
scripts/quote_figures.py --check

if [[ -n ${CHOREO_RECORDINGS:-} ]]; then
  echo "== The figures can be measured again"
  pages=(docs/figures docs/results.md docs/controls.md)
  # Uncommitted changes are no figures to compare with.
  git diff --exit-code --stat HEAD -- "${pages[@]}" || {
    echo "verify.sh: commit the pages above first, or take them back" >&2
    exit 1
  }
  scripts/evaluate.sh "$build/bin" "$CHOREO_RECORDINGS"
  git diff --exit-code -- "${pages[@]}" || {
    echo "verify.sh: other figures than the committed ones. Where they are meant to be (a new checkpoint, another metric), read docs/results.md" >&2
    echo "again and commit docs/; otherwise find what changed them: model, data, or code" >&2
    exit 1
  }
fi

echo "== The installed package serves a stranger"
cmake --install "$build" --prefix "$scratch/prefix" >/dev/null
cmake -S "$root/examples/client" -B "$scratch/consumer" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" >/dev/null
cmake --build "$scratch/consumer"
"$scratch/prefix/bin/choreo" --version
# Nobody listens on port 1: the error shows that the program runs.
if "$scratch/consumer/first_dance" 127.0.0.1:1 2>"$scratch/said"; then
  echo "verify.sh: first_dance should have failed without a server" >&2
  exit 1
fi
grep -q "127.0.0.1:1" "$scratch/said"

echo "== A model of one's own, from recordings"
tests/lab/train_script.sh "$build"
tests/lab/train_papers_script.sh "$build"

echo "== The studio in a browser"
scripts/install_packages.sh browser
tests/studio/browser/run.sh "$build"

echo "== A character on a page"
tests/examples/web/run.sh "$build"

echo "== Blender: our BVH files, and the add-on"
scripts/install_packages.sh blender || echo "verify.sh: no Blender comes from here" >&2
CHOREO_SKIP_CODE=0 tests/formats/blender/run.sh "$build"
CHOREO_SKIP_CODE=0 tests/examples/blender/run.sh "$build"

echo "== Somebody else's character: npm's mannequin"
CHOREO_SKIP_CODE=0 tests/formats/mannequin/run.sh "$build"

echo "== The dashboard, as a Prometheus answers it"
scripts/install_packages.sh verify
scripts/draw_dashboard.py "$build" "$scratch/dashboard.png" --minutes 2

echo "== Faults that are injected for longer"
scripts/faults.sh "$build"

echo "== libFuzzer on every parser and call, ten minutes each"
scripts/install_packages.sh fuzz
cmake --preset fuzz >/dev/null
cmake --build build/fuzz -j "$(nproc)" --target choreo_fuzz
scripts/fuzz.sh build/fuzz 600

echo "== The container builds and dances"
"$root/scripts/verify_container.sh" "$build"

echo "== Without the service: the model, choreo-lab, and their tests"
cmake --preset release -B build/model -DCHOREO_SERVICE=OFF >/dev/null
cmake --build build/model -j "$(nproc)"
scripts/run_tests.sh build/model

for preset in asan tsan; do
  echo "== Tests under $preset"
  cmake --preset "$preset" >/dev/null
  # Not the programs: they run LibTorch, which is not built for sanitizers and is excluded from these tests.
  cmake --build "build/$preset" -j "$(nproc)" --target choreo_tests
  scripts/run_tests.sh "build/$preset"
done

if [[ -n ${CHOREO_RECORDINGS:-} ]]; then
  echo "verify.sh: all is well, the figures included"
else
  echo "verify.sh: all is well, BUT NO FIGURE WAS MEASURED: CHOREO_RECORDINGS names no folder of recordings (docs/results.md)" >&2
fi
