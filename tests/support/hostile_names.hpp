#pragma once

#include <string>
#include <vector>

#include "support/hostile_cases.hpp"

namespace support {

/// Names of files that mean something in one of the languages that recoil writes: shell, GNU
/// parallel, Slurm, Python, LAMMPS, C, OpenFOAM, HTML, URLs, CSV, terminals. What runs in them
/// makes a file PWNED. Each call counts them as tried once more.
inline const std::vector<std::string>& hostile_names() {
  static const std::vector<std::string> names = {
      "$(touch PWNED)",
      "`touch PWNED`",
      "'; touch PWNED; '",
      "\"; touch PWNED; \"",
      "'\"'\"; touch PWNED #",
      "&& touch PWNED &",
      "| touch PWNED",
      "> PWNED",
      "a\\",
      "~",
      "*",
      "-rf",
      "--help",
      "{= system(q(touch PWNED)) =}",
      "{} {#} {.} {1} {2}",
      "%A %a %j %%",
      "@FOLDER@",
      "\"\"\"",
      "'''",
      "\"\"\"\nimport os; os.system('touch PWNED')\n\"\"\"",
      "coding=unicode_escape\\nimport\\x20os;os.system('touch\\x20PWNED')\\n#",
      "coding: utf-7",
      "$V ${V} $(v_e) &",
      "shell touch PWNED &",
      "*/ int broken[-1]; /*",
      "*/",
      "?\?/",
      "#include \"no-such-file\"",
      "javascript:alert(1)",
      "<script>document.title='PWNED'</script>",
      "\"><img src=x onerror=\"document.title='PWNED'\">",
      "a#b?c%41&amp;d",
      "http:example.org",
      "{/:Bold x} @a^b_c",
      "system('touch PWNED')",
      "=1+1",
      "a,b;c\"d\"",
      " blanks ",
      "two\nlines",
      "tab\tand return\r",
      "\x1b[31mred",
      "\xc2\x9b"
      "31mred",
      "\x07\x7f",
      "\xff\xfe",
      "\xc3",
      "ünï – ☃"};
  count_hostile_cases(names.size());
  return names;
}

}  // namespace support
