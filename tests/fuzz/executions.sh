#!/usr/bin/env bash
# executions.sh FOLDER NUMBER [NAME...]: runs fuzz targets (default: all) one after the other until each has been
# executed NUMBER times in all, on new inputs. FOLDER holds the built targets; how often each has
# been executed stands in FOLDER/executions/NAME, and the inputs that reach new code are kept in FOLDER/found/NAME, so
# that a run that is stopped goes on where it was. Ends with status 1 at the first finding.
#   cmake --preset fuzz && cmake --build --preset fuzz --target fuzz_{dataset,events,fit,import}
#   tests/fuzz/executions.sh build/fuzz/tests/fuzz 10000000
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) || exit 1
if [ $# -lt 2 ] || [[ ! $2 =~ ^[1-9][0-9]*$ ]]; then
  sed -n '2,7s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
  exit 2
fi
folder=$(realpath "$1") || exit 2
wanted=$2
shift 2
[ $# -gt 0 ] || set -- dataset events fit import
slice=200000 # a run that is stopped loses the count of no more
# Several times as many in the same time: short inputs, up to 1024 bytes in one of ten slices;
# files in memory; no stacks of allocations (a finding is looked at with fuzz.sh, which has them); leaks are looked
# for at the end of a slice alone; every input is as likely as the others; and two minutes for each on a machine that
# does much else (a slow one is found by the tests).
declare -A short=([dataset]=512)
[ -w /dev/shm ] && export TMPDIR=/dev/shm
export ASAN_OPTIONS=malloc_context_size=0:quarantine_size_mb=16:allocator_release_to_os_interval_ms=-1${ASAN_OPTIONS:+:$ASAN_OPTIONS}
mkdir -p "$folder/executions" || exit 1
for name in "$@"; do
  count=$folder/executions/$name
  log=$folder/executions/$name.log
  while done=$(cat "$count" 2>/dev/null || echo 0) && [ "$done" -lt "$wanted" ]; do
    rest=$((wanted - done))
    longest=$((done / slice % 10 == 9 ? 1024 : ${short[$name]:-256}))
    "$here/fuzz.sh" "$folder/fuzz_$name" "$name" "$folder/found/$name" -runs=$((rest < slice ? rest : slice)) \
      -max_len=$longest -entropic=0 -reduce_inputs=0 -reload=0 -detect_leaks=0 -print_funcs=0 \
      -timeout=120 -print_final_stats=1 >"$log" 2>&1 </dev/null || {
      echo "fuzz_$name: a finding, or stopped, after $done executions; the end of $log:"
      tail -n 40 "$log"
      exit 1
    }
    more=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
    echo $((done + more)) >"$count.new" && mv "$count.new" "$count"
  done
  echo "fuzz_$name: $(cat "$count") executions, no finding"
done
