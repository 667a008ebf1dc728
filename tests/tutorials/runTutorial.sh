#!/usr/bin/env bash
# runTutorial.sh BIN TUTORIAL [options]: copies the tutorials, runs one with its own Allrun, and removes the copy; with CORPUSCLE_KEEP, the copy is made in that
# folder and stays.
set -euo pipefail
bin=$1 tutorial=$2
shift 2
repository=$(cd "$(dirname "$0")/../.." && pwd)
copy=${CORPUSCLE_KEEP:-$(mktemp -d)}
[ -n "${CORPUSCLE_KEEP:-}" ] || trap 'rm -rf "$copy"' EXIT
cp -r "$repository/tutorials" "$copy/tutorials"
cd "$copy/tutorials/$tutorial"
PYTHONPATH=$repository/python CORPUSCLE_BIN=$bin CORPUSCLE_TUTORIALS=$copy/tutorials ./Allrun "$@"
[ -s run.json ] || ls runs/*/run.json >/dev/null
find . -path '*/postProcessing/paraviewState.py' | grep -q .
