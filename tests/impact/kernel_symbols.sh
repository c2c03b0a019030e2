#!/usr/bin/env bash
# kernel_symbols.sh OBJECT...: no inline function may be left behind by two of these compilations
# for different instruction sets, because the linker keeps only one of them.
set -eu
shared=$(for object in "$@"; do
  nm --defined-only "$object" | awk '$2 ~ /^[WVu]$/ { print $3 }' | sort -u
done | sort | uniq -d | grep -v '^DW\.ref\.' || true)
if [ -n "$shared" ]; then
  echo "defined in more than one kernel:"
  echo "$shared" | c++filt
  exit 1
fi
echo "$# kernels share no inline function"
