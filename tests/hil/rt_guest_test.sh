#!/bin/bash
# toolchain/rt gives a command a PREEMPT_RT kernel with two buses and hands back what it says and leaves: output, errors, status, files. Two
# runs are the same, byte for byte and to the nanosecond.
set -euo pipefail
cd "$(dirname "$(readlink -f "$0")")/../.."
work=$(mktemp -d /var/tmp/ivo-hil.XXXXXX)
trap 'rm -rf "$work"' EXIT
fail() { echo "rt_guest_test: $*" >&2; exit 1; }

mkdir -p "$work/brought/inner" "$work/scratch"
export TMPDIR=$work/scratch
echo 'brought along' >"$work/brought/inner/note"
# shellcheck disable=SC2016
guest='
  cat /sys/kernel/realtime
  echo "$0 in $PWD"
  cat /given/inner/note
  for bus in vcan0 vcan1; do
    chrt -f 80 candump -L -n 4 "$bus" >"$bus.log" &
    until grep -q "^ *$bus " /proc/net/can/rcvlist_all; do sleep 0.01; done
    cangen -n 4 -g 2 "$bus"
  done
  wait
  mkdir inner
  head -c 1000 /dev/urandom >inner/chance
  head -c 300000 /dev/zero >inner/large
  dmesg >kernel.log
  cat /proc/uptime
  echo complained >&2
  exit 7'
toolchain/rt true 2>"$work/err" || fail "a guest does not do nothing: $(tail -n 3 "$work/err")"  # the first one says that it fetches a kernel
for n in 1 2; do
  status=0
  toolchain/rt -t 2400 -f "$work/brought:/given" -o "$work/files$n" sh -c "$guest" "two words" >"$work/out$n" 2>"$work/err$n" || status=$?
  [ "$status" -eq 7 ] || fail "status is $status; expected 7, the command's; $(tail -n 3 "$work/err$n")"
done
[ "$(sed -n 1p "$work/out1")" = 1 ] || fail "the kernel does not say that it is a real-time one: $(sed -n 1p "$work/out1")"
[ "$(sed -n 2p "$work/out1")" = 'two words in /run/work' ] || fail "the arguments or the folder differ: $(cat "$work/out1")"
[ "$(sed -n 3p "$work/out1")" = 'brought along' ] || fail "the file brought along is not there: $(cat "$work/out1")"
[ "$(cat "$work/err1")" = complained ] || fail "standard error is: $(cat "$work/err1")"
for bus in vcan0 vcan1; do
  [ "$(grep -cE "^\([0-9]{10}\.[0-9]{6}\) $bus [0-9A-F]{3}#[0-9A-F]*$" "$work/files1/$bus.log")" = 4 ] ||
    fail "$bus.log does not hold the 4 frames sent: $(cat "$work/files1/$bus.log")"
done
[ "$(stat -c %s "$work/files1/inner/large")" = 300000 ] || fail "a large file did not come back whole"
diff -r "$work/files1" "$work/files2" || fail "two runs left different files"
cmp "$work/out1" "$work/out2" || fail "two runs said different things"

# Devices: two CAN controllers on one bus, and a watchdog that resets the guest, which is an end of its own kind.
# shellcheck disable=SC2016
hardware='
  for bus in can0 can1; do ip link set "$bus" type can bitrate 1000000 && ip link set "$bus" up; done
  candump -L -n 1 can1 &
  until grep -q "^ *can1 " /proc/net/can/rcvlist_all; do sleep 0.01; done
  cansend can0 181#112233
  wait
  echo 1 >/dev/watchdog
  sleep 1000
  echo "not reset"'
status=0
toolchain/rt -t 2400 -d kvaser -d watchdog sh -c "$hardware" >"$work/out" 2>"$work/err" || status=$?
grep -q 'can1 181#112233$' "$work/out" || fail "no frame came from can0 to can1: $(cat "$work/out" "$work/err")"
[ "$status" -eq 125 ] || fail "status after the watchdog is $status; expected 125"
! grep -q 'not reset' "$work/out" || fail "the watchdog did not reset the guest"

# What it cannot do it says in a line, with a status that is not the command's.
refused() {
  local expected=$1 status=0
  shift
  toolchain/rt "$@" >"$work/out" 2>"$work/err" || status=$?
  [ "$status" -eq "$expected" ] || fail "toolchain/rt $*: status $status, expected $expected"
}
refused 2
refused 125 -f "$work/absent" true
grep -q "$work/absent is not there" "$work/err" || fail "a missing file is not named: $(cat "$work/err")"
refused 125 -d lamp true
refused 125 -m much true
refused 127 no-such-command
refused 124 -t 1 sleep 1000000

# Ended from outside it leaves nothing, and nobody running.
machines() { grep -lasF -- "-initrd" /proc/[0-9]*/cmdline | xargs -r grep -lasF -- "$TMPDIR" || true; }
toolchain/rt sleep 1000000 >"$work/out" 2>"$work/err" &
outer=$!
until [ -n "$(machines)" ]; do
  kill -0 "$outer" || fail "the guest did not begin: $(cat "$work/err")"
  sleep 0.1
done
kill -TERM "$outer"
status=0
wait "$outer" || status=$?
[ "$status" -eq 143 ] || fail "status after SIGTERM is $status; expected 143"
[ -z "$(machines)" ] || fail "of the guest these go on: $(machines)"
[ -z "$(ls "$TMPDIR")" ] || fail "scratch folders are left: $(ls "$TMPDIR")"
