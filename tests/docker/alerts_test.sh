#!/usr/bin/env bash
# Has promtool (Debian: prometheus) judge docker/monitoring.yaml by alerts_test.yaml. Ends with 77 where it is not installed.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
command -v promtool >/dev/null || { echo "promtool is not installed"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# The groups of the PrometheusRule, which are its last part, as a file of Prometheus.
sed -n '/^  groups:/,$s/^  //p' "$here/../../docker/monitoring.yaml" > "$folder/all.yaml"
promtool check rules "$folder/all.yaml"
# Each expected alert would have to repeat its words.
grep -v annotations: "$folder/all.yaml" > "$folder/rules.yaml"
cp "$here/alerts_test.yaml" "$folder"
promtool test rules "$folder/alerts_test.yaml"
