# cmake -DDOCS=FOLDER -DTOPICS="a b c" -DOUT=FILE -P embed_manual.cmake: writes the pages as a source.
string(REPLACE " " ";" topics "${TOPICS}")
set(source "#include \"cli/manual.hpp\"\n\nnamespace recoil {\n\n")
string(APPEND source "std::span<const ManualPage> manual_pages() {\n")
string(APPEND source "  static constexpr ManualPage pages[] = {\n")
foreach(topic ${topics})
  file(READ "${DOCS}/${topic}.md" text)
  string(REGEX REPLACE "<!--[^>]*-->\n?" "" text "${text}") # for ./run docs and the tests
  string(APPEND source "{\"${topic}\", R\"page(" "${text}" ")page\"},\n")
endforeach()
string(APPEND source "  };\n  return pages;\n}\n\n}  // namespace recoil\n")
file(WRITE "${OUT}" "${source}")
