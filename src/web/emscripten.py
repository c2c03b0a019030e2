# Debian's emscripten with a cache that can be written: its own has no libraries with exceptions.
EMSCRIPTEN_ROOT = "/usr/share/emscripten"
LLVM_ROOT = "/usr/bin"
BINARYEN_ROOT = "/usr"
NODE_JS = "/usr/bin/node"
FROZEN_CACHE = False
LLVM_ADD_VERSION = "14"
CLANG_ADD_VERSION = "14"
