#!/usr/bin/env bash
# Paper C's own setting, a random 80/20 split of clips, whose test clips are of dancers who train too: prints splits.json of one prepared set.
#   scripts/random_split.sh FOLDER
# In the order of the SHA-256 of their names a fifth of the clips tests, the next twentieth validates, the others train.
set -euo pipefail
cd "$1"
for clip in *.clip; do
  name=${clip%.clip}
  echo "$(printf %s "$name" | sha256sum | cut -d ' ' -f 1) $name"
done | LC_ALL=C sort | awk -v set="$(basename "$PWD")" '
  { names[NR] = "\"" $2 "\"" }
  function list(from, to,   i, text) { for (i = from; i <= to; ++i) text = text (i > from ? ", " : "") names[i]; return "[" text "]" }
  END {
    test = int(NR / 5 + 0.5); held = test + int(NR / 20 + 0.5)
    print "{\"" set "\": {\"test\": " list(1, test) ", \"validation\": " list(test + 1, held) "}}"
  }'
