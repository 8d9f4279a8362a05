#!/usr/bin/env bash
# Has promtool (Debian: prometheus) judge docker/prometheus.yaml, and docker/alerts.yaml by alerts_test.yaml. Ends with 77 where it is not installed.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
command -v promtool >/dev/null || { echo "promtool is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
rules=$here/../../docker/alerts.yaml
promtool check rules "$rules"
promtool check config "$here/../../docker/prometheus.yaml"
# Each expected alert would have to repeat its words.
grep -v annotations: "$rules" > "$folder/rules.yaml"
cp "$here/alerts_test.yaml" "$folder"
promtool test rules "$folder/alerts_test.yaml"
