"""build/web/recoil.html in headless Chromium, opened from the disk."""

import base64
import json
import pathlib
import sys

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests/report"))
import open_in_chromium as chromium  # noqa: E402

chromium.TIME_LIMIT = 900
PAGE = root / "build/web/recoil.html"


class Tab:
    """The page in Chromium."""

    def __init__(self, width=1280, height=900, dark=False):
        self.browser = chromium.Browser(chromium.installed_chromium())
        self.session, _ = chromium.open_page(self.browser, PAGE, width, height, width < 600)
        self.browser.call("Emulation.setEmulatedMedia", self.session, features=[
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])
        self.evaluate("new Promise((done) => { const wait = setInterval(() => {"
                      " if (!worker && document.querySelector('#materials option')) {"
                      " clearInterval(wait); done(1); } }, 100); })")

    def evaluate(self, expression):
        answer = self.browser.call("Runtime.evaluate", self.session, expression=expression,
                                   awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(json.dumps(answer["exceptionDetails"])[:600])
        return answer["result"].get("value")

    def run(self, files, args):
        """What the command prints and writes: {status, out, err, seconds, files}, files as bytes."""
        sent = {path: base64.b64encode(content).decode() for path, content in files.items()}
        done = json.loads(self.evaluate(
            "(async () => {"
            " const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));"
            " const text = (bytes) => { let s = ''; for (const b of bytes) s += String.fromCharCode(b); return btoa(s); };"
            f" files = new Map(Object.entries({json.dumps(sent)}).map(([p, t]) => [p, bytes(t)]));"
            f" const done = await run({json.dumps(args)});"
            " done.files = Object.fromEntries([...files].map(([p, b]) => [p, text(b)]));"
            " return JSON.stringify(done); })()"))
        done["files"] = {path: base64.b64decode(content) for path, content in done["files"].items()}
        return done
