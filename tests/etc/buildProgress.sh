#!/usr/bin/env bash
# What ./Allrun shows of a build, with a cmake of our own: progress, the log, and that a failure stays one.
set -uo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
root=$(cd "$(dirname "$0")/../.." && pwd)
CORPUSCLE_BUILD=$folder/build
. "$root/etc/functions.sh"
fail() { echo "FAILED: $1"; echo "$said"; exit 1; }

cat >"$folder/cmake" <<'X'
#!/usr/bin/env bash
[ "$1" = --build ] || exit 0
steps=${STEPS:-40}
for i in $(seq "$steps"); do echo "[$i/$steps] Building x$i"; done
[ -z "${FAULT:-}" ] || echo "x.cpp:1: error: $FAULT"
printf 'last words'
[ -z "${FAULT:-}" ]
X
chmod +x "$folder/cmake"
PATH=$folder:$PATH

said=$(configure_and_build --) || fail "a build that ends well"
[ "$(grep -c '^building: .* of 40, .* %, .* s$' <<<"$said")" -eq 10 ] || fail "a line for each tenth"
[ "$(wc -l <"$folder/build/build.log")" -eq 41 ] || fail "the log has every line, the last one too"
said=$(STEPS=5 configure_and_build --) && [ -z "$said" ] || fail "a build of a few steps is silent"
said=$(FAULT=broken configure_and_build --) && fail "a failure stays one"
grep -q 'error: broken' <<<"$said" || fail "the error is shown"
set +o pipefail
export -f configure_and_build build_progress
export root build
said=$(FAULT=broken bash -c 'configure_and_build --') && fail "a failure stays one in a shell without pipefail"
exit 0
