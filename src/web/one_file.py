#!/usr/bin/env python3
"""Puts the program and the page into one HTML file.

usage: one_file.py FOLDER_OF_PROGRAM VERSION OUTPUT
"""

import base64
import gzip
import hashlib
import json
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent


def hash_of(text):
    """The source expression of an inline script or style (CSP level 3)."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


def examples():
    """Every shipped fit of one dataset, with its dataset: {name: {path: text}}."""
    found = {}
    for fit in sorted((root / "fits").glob("*.toml")):
        dataset = root / "datasets" / fit.stem
        if not dataset.is_dir():
            continue
        paths = [fit, *sorted(path for path in dataset.iterdir() if path.suffix in (".json", ".csv"))]
        found[fit.stem] = {str(path.relative_to(root)): path.read_text() for path in paths}
    return found


def main():
    program, version, output = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
    script = (here / "page.js").read_text()
    save = "\n" + (root / "src/document/save.js").read_text()
    # The pages that the program makes have one of these scripts; a frame obeys the policy of its page.
    own = [script, save, save + (root / "src/report/explore.js").read_text()]
    style = (here / "page.css").read_text()
    sheet = (root / "src/document/html_style.cpp").read_text().split('R"css(')[1].split(')css"')[0]
    policy = ("default-src 'none'; script-src 'wasm-unsafe-eval' " + " ".join(hash_of(one) for one in own) +
              "; worker-src blob:; style-src " + " ".join(hash_of(one) for one in ("\n" + style, "\n" + sheet)) +
              "; img-src data: blob:; base-uri 'none'; form-action 'none'")
    packed = gzip.compress((program / "recoil.wasm").read_bytes(), mtime=0)
    worker = (program / "recoil.js").read_text() + (here / "worker.js").read_text()
    page = (here / "page.html").read_text()
    for name, text in {
            "policy": policy, "style": style, "version": version,
            "wasm": base64.b64encode(packed).decode(),
            "examples": json.dumps(examples()).replace("</", "<\\/"),
            "worker": worker.replace("</script", "<\\/script"), "script": script}.items():
        page = page.replace(f"@{name}@", text, 1)
    output.write_text(page)
    print(f"{output}: {output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
