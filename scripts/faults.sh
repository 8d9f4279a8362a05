#!/usr/bin/env bash
# Runs the faults of docs/reliability.md that take too long for `make test`; each prints its figure.
#   scripts/faults.sh BUILD_DIRECTORY
set -euo pipefail
bin=$1/bin

echo "== Three replicas, 60 dances in real time, one server lost every 2 s, for a minute"
CHOREO_FAULT_STREAMS=60 CHOREO_FAULT_SECONDS=60 "$bin/client_test" --gtest_brief=1 --gtest_filter='ReplicaFaultTest.*'

echo "== However a call ends, all that it had comes back: 200 calls of each kind"
CHOREO_FAULT_ROUNDS=200 "$bin/server_test" --gtest_brief=1 --gtest_filter='Calls/CleanupTest.*'

echo "== Hostile clients"
CHOREO_FAULT_CALLS=50000 "$bin/server_test" --gtest_brief=1 --gtest_filter='HostileTest.*'

echo "== One client that takes all it can get of something, beside nine that dance in real time, for 20 s each"
CHOREO_FAULT_SECONDS=20 "$bin/server_test" --gtest_brief=1 --gtest_filter='*GreedyTest.*'

echo "== A network that loses, delays and disorders packets, for a minute (as root)"
CHOREO_FAULT_SECONDS=60 "$bin/network_test" --gtest_brief=1

echo "== Half an hour among clients that crash, fall silent and want too much"
"$bin/soak" --minutes 30
