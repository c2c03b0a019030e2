#!/usr/bin/env bash
# fuzz.sh PROGRAM NAME FOUND [OPTION...]: one fuzz target with its corpus and its dictionary, within
# the limits that all targets have. What it finds goes to the folder FOUND; OPTIONs are libFuzzer's.
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd) || exit 1
program=$1 name=$2 found=$3
shift 3
# A fixed seed asks for a fixed sequence: it begins with the corpus alone.
[[ " $* " == *" -seed="* ]] && rm -rf "$found"
mkdir -p "$found"
exec "$program" -rss_limit_mb=2048 -timeout=10 -max_len=8192 -dict="$here/$name.dict" \
  -artifact_prefix="$found/" "$@" "$found" "$here/corpus/$name"
