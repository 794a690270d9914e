# shellcheck shell=bash
# What the guests share: where a user-mode Linux keeps its memory, how it is started, and that it does not outlive its caller.

# uml_prepare: leaves a folder for the guest's small files in $run, which is removed when the caller ends.
uml_prepare() {
  memory=${IVO_VCAN_MEM:-1G}
  local folder
  for folder in /dev/shm /tmp /var/tmp; do
    if uml_holds_memory "$folder"; then
      memory_folder=$folder
      break
    fi
  done
  [ -n "${memory_folder-}" ] || { echo "toolchain/vcan: neither /dev/shm, /tmp nor /var/tmp has $memory for the guest" >&2; exit 125; }
  run=$(mktemp -d /var/tmp/ivo-vcan.XXXXXX)
  kernel=
  trap uml_finish EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
  # The guest's kernel knows no vector registers as large as some processors have.
  preload=
  if grep -qw amx_tile /proc/cpuinfo; then
    preload=$run/whole_xstate.so
    g++ -std=c++20 -O2 -shared -fPIC -o "$preload" "$(dirname "${BASH_SOURCE[0]}")/whole_xstate.cpp" ||
      { echo "toolchain/vcan: no compiler for whole_xstate.cpp, without which no guest starts on this processor" >&2; exit 125; }
  fi
}

# The guest's memory is a file that must be mapped executable: /dev/shm may be missing, too small or mounted noexec.
uml_holds_memory() {
  local probe status=0
  [ "$(df --output=avail -B1 "$1" 2>/dev/null | tail -n 1)" -ge "$(numfmt --from=iec "$memory")" ] 2>/dev/null || return 1
  probe=$(mktemp "$1/ivo-vcan.XXXXXX" 2>/dev/null) || return 1
  install -m 700 /bin/true "$probe"
  "$probe" 2>/dev/null || status=1
  rm -f "$probe"
  return "$status"
}

# shellcheck disable=SC2317
uml_finish() {
  trap - EXIT INT TERM HUP
  if [ -n "$kernel" ]; then
    kill -TERM "$kernel" 2>/dev/null || true
    for _ in {1..20}; do kill -0 "$kernel" 2>/dev/null && sleep 0.05; done
    kill -KILL -- "-$kernel" 2>/dev/null || true
  fi
  wait 2>/dev/null
  rm -rf "$run"
}

# uml_run ROOT ARGS...: boots ROOT with these arguments of the kernel, and waits for its end. Its console is in $run/console.
uml_run() {
  # A session of its own, so that Ctrl-C ends the guest by one signal to the group; no terminal, so that it cannot change the
  # mode of the caller's. The guest's kernel and its one CPU are two processes that wait for each other: on two idle processors
  # they take four times as long.
  local root=$1 cpu
  shift
  cpu=$(taskset -cp $$ | sed 's/.*: //; s/[-,].*//')
  TMPDIR=$memory_folder LD_PRELOAD=$preload setsid taskset -c "$cpu" linux.uml mem="$memory" root=/dev/root rootfstype=hostfs hostfs="$root" rw \
    uml_dir="$run" con=null con0=null,fd:1 "$@" </dev/null >"$run/console" 2>&1 &
  kernel=$!
  wait "$kernel" || true
  kernel=
}

# uml_last_words WHAT: for a guest that ended before WHAT did.
uml_last_words() {
  echo "toolchain/vcan: the guest stopped before $1 ended; its last words:" >&2
  tail -n 10 "$run/console" >&2
  exit 125
}
