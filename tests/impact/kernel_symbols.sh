#!/usr/bin/env bash
# kernel_symbols.sh OBJECT...: no inline function may be left behind by two of these compilations
# for different instruction sets, because the linker keeps only one of them. Objects of one folder
# are of one instruction set.
set -eu
folders=$(dirname "$@" | sort -u)
shared=$(while IFS= read -r folder; do
  for object in "$@"; do
    if [ "$(dirname "$object")" = "$folder" ]; then
      nm --defined-only "$object" | awk '$2 ~ /^[WVu]$/ { print $3 }'
    fi
  done | sort -u
done <<<"$folders" | sort | uniq -d | grep -v '^DW\.ref\.' || true)
if [ -n "$shared" ]; then
  echo "defined in more than one kernel:"
  echo "$shared" | c++filt
  exit 1
fi
echo "$(echo "$folders" | wc -l) kernels share no inline function"
