#!/bin/bash
# toolchain/vcan gives a command two real buses and hands back what it says: output, errors, status, environment.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "vcan_test: $*" >&2; exit 1; }

status=0
IVO_GREETING='two words' toolchain/vcan bash -c '
  for bus in vcan0 vcan1; do
    candump -n 1 -T 5000 -L "$bus" >"$0/$bus" & candump=$!
    for _ in {1..50}; do
      cansend "$bus" 181#11.22.33
      sleep 0.1
      kill -0 "$candump" 2>/dev/null || break
    done
    wait
  done
  echo "said $IVO_GREETING in $PWD"
  echo "complained" >&2
  exit 7' "$work" >"$work/out" 2>"$work/err" || status=$?

[ "$status" -eq 7 ] || fail "status is $status; expected 7, the command's; $(tail -n 1 "$work/err")"
grep -q 'vcan0 181#112233$' "$work/vcan0" || fail "no frame came over vcan0"
grep -q 'vcan1 181#112233$' "$work/vcan1" || fail "no frame came over vcan1"
[ "$(cat "$work/out")" = "said two words in $PWD" ] || fail "standard output is: $(cat "$work/out")"
[ "$(cat "$work/err")" = "complained" ] || fail "standard error is: $(cat "$work/err")"
