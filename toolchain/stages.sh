# shellcheck shell=bash disable=SC2154
# Runs named stages one after the other for toolchain/test, which defines run_stage, root and logs. Shows what each is doing,
# keeps its output, and ends with a table and the sum of the tests.

passed=0
failed=0
skipped_in_all=0
table=()

# A line of the stage's output every few seconds: enough to see that it moves and where.
show_progress() {
  local line next=$((SECONDS + 5))
  while IFS= read -r line; do
    printf '%s\n' "$line" >>"$1"
    if ((SECONDS >= next)); then
      printf '    %.110s\n' "$line"
      next=$((SECONDS + 5))
    fi
  done
}

# Adds the counts of a stage that ran ctest; a test that was skipped did not pass.
count() {
  local report=$1 total wrong skipped
  [ -f "$report" ] || return 0
  # The suite's own attributes are the first of their names in the report.
  total=$(grep -m 1 -oP '\btests="\K[0-9]+' "$report")
  wrong=$(grep -m 1 -oP '\bfailures="\K[0-9]+' "$report")
  skipped=$(grep -m 1 -oP '\bskipped="\K[0-9]+' "$report")
  passed=$((passed + total - wrong - skipped))
  failed=$((failed + wrong))
  skipped_in_all=$((skipped_in_all + skipped))
}

finish() {
  printf '\n%-16s %8s\n' stage minutes
  printf '%s\n' "${table[@]}"
  printf '\n%d passed, %d failed, %d skipped\n' "$passed" "$failed" "$skipped_in_all"
}

# What the tests that failed said, of ctest's output: the list of those that were skipped is all that stands at its end.
show_failures() {
  awk '/^ *[0-9]+\/[0-9]+ Test +#/ { shown = /\*\*\*(Failed|Timeout|Exception|Not Run)|Subprocess/ ? 80 : 0 } shown-- > 0' "$1" 2>/dev/null || true
}

run_stages() {
  local number=0 began status before tenths
  for stage in "$@"; do
    number=$((number + 1))
    began=$SECONDS
    before=$failed
    rm -f "$logs/$stage.log" "$logs/$stage.xml"
    printf '[%d/%d] %s\n' "$number" $# "$stage"
    status=0
    # A subshell of its own under `set -e`: inside a condition bash would carry on after a command that failed.
    set +e
    (set -euo pipefail; run_stage "$stage") 2>&1 | show_progress "$logs/$stage.log"
    status=${PIPESTATUS[0]}
    set -e
    count "$logs/$stage.xml"
    tenths=$(((SECONDS - began + 3) / 6))
    table+=("$(printf '%-16s %6d.%d' "$stage" $((tenths / 10)) $((tenths % 10)))")
    if [ "$status" -ne 0 ]; then
      table[-1]+="  FAILED"
      # A stage without tests that fails is a failure too: the sum must not read as success.
      [ "$failed" -gt "$before" ] || failed=$((failed + 1))
      printf '\nstage %s failed; the end of %s:\n' "$stage" "${logs#"$root"/}/$stage.log"
      show_failures "$logs/$stage.log"
      tail -n 40 "$logs/$stage.log" 2>/dev/null || true
      finish
      exit 1
    fi
  done
  finish
}
