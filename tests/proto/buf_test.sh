#!/usr/bin/env bash
# Is the API as buf's STANDARD rules want it, and does it break nobody? What does not apply is named in proto/buf.yaml. Ends with 77
# where buf cannot be had.
#   buf_test.sh lint|breaking
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
"$here/../support/npm_ci.sh" "$here/buf"
buf=$(echo "$here"/buf/node_modules/@bufbuild/buf-linux-*/bin/buf)
cd "$here/../../proto"
case $1 in
  lint) "$buf" lint ;;
  breaking) "$buf" breaking --against "$here/released.txtpb" ;;
esac
