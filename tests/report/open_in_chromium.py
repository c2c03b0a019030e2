#!/usr/bin/env python3
"""Opens pages in headless Chromium and fails on whatever a reader would see go wrong.

usage: open_in_chromium.py [--figures N] [--pictures DIR] [--without-script] [--axe FILE] PAGE.html ...

For every page, at desktop width (1200 px), on a phone (360 px) and as printed on A4 (680 px between
the margins):
  - no console error or warning, no exception, no failed load
  - no request to anything but the page itself
  - every figure holds an SVG with a visible box in which plots are drawn, at least N of them
  - no horizontal scrolling of the page or of a table, no duplicate id, no link to a missing anchor
  - in print no navigation, no links that save, no sliders; the addresses of other pages are readable,
    and no page ends within a picture or a row of a table

--axe FILE runs axe-core (its axe.min.js) on every page as well, at desktop width and on a phone, and fails on
what it finds against WCAG 2.2 A and AA.
--pictures DIR also writes PNG screenshots of both widths and the printed PDF.
Only Python's standard library is used; Chromium is driven by the DevTools protocol over a pipe.
"""

import argparse
import base64
import json
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tempfile
import time

TIME_LIMIT = 180.0  # [s] for one answer of the browser, on a machine that does much else

WIDTHS = {"desktop": (1200, 900, False), "phone": (360, 740, True), "print": (680, 1000, False)}

# Runs inside the page, given the screen's width; returns a list of complaints and what it counted.
INSPECT = r"""
(screen => {
  for (const section of document.querySelectorAll('details.section')) section.open = true;
  const complaints = [];
  const visible = box => box && box.width > 40 && box.height > 40;
  const pictures = [...document.querySelectorAll('.picture')];
  let drawn = 0;
  for (const picture of pictures) {
    const figure = picture.closest('figure, article');
    const name = (figure && figure.id) || 'picture ' + (pictures.indexOf(picture) + 1);
    const svg = picture.querySelector('svg');
    if (!svg) { complaints.push(name + ': no SVG'); continue; }
    const box = svg.getBoundingClientRect();
    if (!visible(box)) { complaints.push(name + ': its SVG has no visible box'); continue; }
    let marks = 0;
    for (const plot of svg.querySelectorAll('g[id*="_plot_"]')) {
      for (const mark of plot.querySelectorAll('path, polyline, polygon, rect, circle, use')) {
        const own = mark.getBoundingClientRect();
        const style = getComputedStyle(mark);
        const painted = style.stroke !== 'none' || style.fill !== 'none';
        if (painted && own.width + own.height > 0.5) ++marks;
      }
    }
    if (marks === 0) { complaints.push(name + ': nothing is plotted in it'); continue; }
    ++drawn;
  }
  for (const svg of document.querySelectorAll('svg')) {
    if (!svg.closest('.picture')) complaints.push('an SVG stands outside a picture');
  }
  const seen = new Set();
  for (const element of document.querySelectorAll('[id]')) {
    if (seen.has(element.id)) complaints.push('duplicate id ' + element.id);
    seen.add(element.id);
  }
  for (const link of document.querySelectorAll('a[href^="#"]')) {
    if (!seen.has(link.getAttribute('href').slice(1)))
      complaints.push('no target for ' + link.getAttribute('href'));
  }
  for (const use of document.querySelectorAll('use')) {
    const target = use.getAttribute('xlink:href') || use.getAttribute('href');
    if (!target || !seen.has(target.slice(1))) complaints.push('no symbol ' + target);
  }
  const page = document.scrollingElement;
  // A phone zooms out of a page that is too wide, so its own innerWidth proves nothing.
  if (page.scrollWidth > screen + 1)
    complaints.push('the page scrolls sideways: ' + page.scrollWidth + ' px in ' + screen + ' px');
  for (const box of document.querySelectorAll('.wide')) {
    if (box.scrollWidth > box.clientWidth + 1)
      complaints.push('a table scrolls sideways: ' + box.innerText.slice(0, 60));
  }
  if (matchMedia('print').matches) {
    for (const element of document.querySelectorAll('nav, .save, details.explore, .explored')) {
      if (element.getBoundingClientRect().height > 0)
        complaints.push('prints ' + element.tagName + ' ' + element.getAttribute('class'));
    }
    for (const element of document.querySelectorAll('figure, tr')) {
      if (getComputedStyle(element).breakInside !== 'avoid')
        complaints.push('a page may end within ' + element.tagName);
    }
    for (const table of document.querySelectorAll('.wide > table')) {
      if (table.rows.length <= 15 && getComputedStyle(table.parentElement).breakInside !== 'avoid') {
        complaints.push('cuts a table of ' + table.rows.length + ' rows in print');
      }
    }
    for (const link of document.querySelectorAll('a[href^="http"], a[href$=".html"]')) {
      if (!getComputedStyle(link, '::after').content.includes(link.getAttribute('href')) &&
          link.getBoundingClientRect().height > 0)
        complaints.push('does not print where ' + link.getAttribute('href') + ' is');
    }
  }
  const made = document.querySelectorAll('.save, .explore:not(script)').length;
  return {complaints: [...new Set(complaints)], drawn, made, height: page.scrollHeight};
})"""


class Browser:
    """Chromium with its DevTools on a pair of pipes; everything it says is kept in `events`."""

    def __init__(self, program):
        self.profile = tempfile.mkdtemp(prefix="recoil-chromium-")
        to_browser_read, self.write_end = os.pipe()
        self.read_end, from_browser_write = os.pipe()

        def connect():  # DevTools reads descriptor 3 and writes descriptor 4
            os.dup2(to_browser_read, 13)
            os.dup2(from_browser_write, 14)
            os.dup2(13, 3)
            os.dup2(14, 4)
            for descriptor in (3, 4):
                os.set_inheritable(descriptor, True)

        self.process = subprocess.Popen(
            [program, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
             "--no-first-run", "--disable-background-networking", "--disable-component-update",
             "--disable-sync", "--disable-dev-shm-usage", "--hide-scrollbars",
             "--user-data-dir=" + self.profile, "--remote-debugging-pipe", "about:blank"],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            close_fds=False, preexec_fn=connect)
        os.close(to_browser_read)
        os.close(from_browser_write)
        self.buffer = b""
        self.counter = 0
        self.events = []

    def close(self):
        try:
            self.call("Browser.close")
        except (RuntimeError, OSError):
            pass
        try:
            self.process.wait(timeout=10)
        except subprocess.TimeoutExpired:
            self.process.kill()
            self.process.wait()
        os.close(self.write_end)
        os.close(self.read_end)
        shutil.rmtree(self.profile, ignore_errors=True)

    def receive(self, deadline):
        while b"\0" not in self.buffer:
            ready, _, _ = select.select([self.read_end], [], [], max(0, deadline - time.time()))
            if not ready:
                raise RuntimeError("Chromium does not answer")
            chunk = os.read(self.read_end, 1 << 20)
            if not chunk:
                raise RuntimeError("Chromium ended before it answered")
            self.buffer += chunk
        message, self.buffer = self.buffer.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, session=None, **params):
        self.counter += 1
        request = {"id": self.counter, "method": method, "params": params}
        if session:
            request["sessionId"] = session
        os.write(self.write_end, json.dumps(request).encode() + b"\0")
        deadline = time.time() + TIME_LIMIT
        while True:
            message = self.receive(deadline)
            if message.get("id") == self.counter:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']['message']}")
                return message["result"]
            self.events.append(message)

    def wait_for(self, method):
        deadline = time.time() + TIME_LIMIT
        while not any(event.get("method") == method for event in self.events):
            self.events.append(self.receive(deadline))


def complaints_in(events, address):
    """What the browser said about the page while it loaded."""
    found = []
    for event in events:
        method, params = event.get("method"), event.get("params", {})
        if method == "Runtime.consoleAPICalled" and params["type"] in ("error", "warning", "assert"):
            words = [str(a.get("value", a.get("description", ""))) for a in params["args"]]
            found.append("console " + params["type"] + ": " + " ".join(words))
        elif method == "Runtime.exceptionThrown":
            details = params["exceptionDetails"]
            found.append("exception: " + details.get("exception", {}).get("description",
                                                                         details["text"]))
        elif method == "Log.entryAdded" and params["entry"]["level"] in ("error", "warning"):
            found.append("log: " + params["entry"]["text"])
        elif method == "Network.requestWillBeSent":
            url = params["request"]["url"]
            if url.split("#")[0] != address and not url.startswith(("data:", "blob:")):
                found.append("request to " + url)
        elif method == "Network.loadingFailed":
            found.append("load failed: " + params["errorText"])
        elif method == "Inspector.targetCrashed":
            found.append("the page crashed the browser")
    return found


def open_page(browser, page, width, height, mobile, with_script=True):
    """The session and the target of a new tab that has loaded `page`."""
    browser.events.clear()
    target = browser.call("Target.createTarget", url="about:blank")["targetId"]
    session = browser.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
    for domain in ("Page", "Runtime", "Log", "Network"):
        browser.call(domain + ".enable", session)
    if not with_script:
        browser.call("Emulation.setScriptExecutionDisabled", session, value=True)
    browser.call("Emulation.setDeviceMetricsOverride", session, width=width, height=height,
                 deviceScaleFactor=1, mobile=mobile)
    browser.call("Page.navigate", session, url=page.resolve().as_uri())
    browser.wait_for("Page.loadEventFired")
    return session, target


def inspect(browser, page, options):
    """Complaints about one page, each prefixed with the width at which it was seen."""
    address = page.resolve().as_uri()
    found = []
    summary = ""
    for name, (width, height, mobile) in WIDTHS.items():
        session, target = open_page(browser, page, width, height, mobile,
                                    not options.without_script)
        if name == "print":
            browser.call("Emulation.setEmulatedMedia", session, media="print")
        answer = browser.call("Runtime.evaluate", session, expression=f"{INSPECT}({width})",
                              returnByValue=True)
        if "exceptionDetails" in answer:
            raise RuntimeError("the inspection itself failed: " + json.dumps(answer)[:400])
        result = answer["result"]["value"]
        complaints = complaints_in(browser.events, address) + result["complaints"]
        if result["drawn"] < options.figures:
            complaints.append(f"{result['drawn']} drawn figures, at least {options.figures} "
                              "expected")
        if options.without_script and result["made"] > 0:
            complaints.append(f"{result['made']} things that only a script makes")
        found += [f"{name}: {complaint}" for complaint in complaints]
        if options.axe and name != "print":
            found += [f"{name}: {complaint}" for complaint in findings_of_axe(browser, session, options)]
        summary = f"{result['drawn']} figures"
        if options.pictures:
            stem = options.pictures / page.stem
            take_pictures(browser, session, stem, name, width, result["height"])
        browser.call("Target.closeTarget", targetId=target)
    return found, summary


def findings_of_axe(browser, session, options):
    """What axe-core finds against WCAG 2.2, levels A and AA, one line each."""
    browser.call("Runtime.evaluate", session, expression=options.axe.read_text())
    answer = browser.call(
        "Runtime.evaluate", session, awaitPromise=True, returnByValue=True,
        expression="""axe.run({resultTypes: ['violations'], runOnly: ['wcag2a', 'wcag2aa',
            'wcag21a', 'wcag21aa', 'wcag22aa']}).then(found => found.violations.map(v =>
            v.id + ': ' + v.help + ' (' + v.nodes.length + ' times, first ' +
            v.nodes[0].html.slice(0, 160) + ')'))""")
    if "exceptionDetails" in answer:
        raise RuntimeError("axe failed: " + json.dumps(answer)[:400])
    return ["axe " + complaint for complaint in answer["result"]["value"]]


def take_pictures(browser, session, stem, name, width, height):
    stem.parent.mkdir(parents=True, exist_ok=True)
    # Chromium's largest texture is 16384 px; a longer page is cut there.
    shot = browser.call("Page.captureScreenshot", session, captureBeyondViewport=True,
                        clip={"x": 0, "y": 0, "width": width, "height": min(height, 16000),
                              "scale": 1})
    pathlib.Path(f"{stem}-{name}.png").write_bytes(base64.b64decode(shot["data"]))
    if name == "desktop":
        printed = browser.call("Page.printToPDF", session, paperWidth=8.27, paperHeight=11.69,
                               preferCSSPageSize=True)
        pathlib.Path(f"{stem}-print.pdf").write_bytes(base64.b64decode(printed["data"]))


def installed_chromium():
    """The path of the browser, or None."""
    return next((p for p in map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))
                 if p), None)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("pages", nargs="+", type=pathlib.Path, metavar="PAGE.html")
    parser.add_argument("--figures", type=int, default=1, help="least number of drawn figures")
    parser.add_argument("--pictures", type=pathlib.Path, help="write screenshots and PDF here")
    parser.add_argument("--axe", type=pathlib.Path, metavar="FILE", help="axe.min.js of axe-core")
    parser.add_argument("--without-script", action="store_true",
                        help="as a browser in which scripts are switched off")
    options = parser.parse_args()
    program = installed_chromium()
    if program is None:
        print("Chromium is not installed (package chromium)", file=sys.stderr)
        return 2
    failed = False
    browser = Browser(program)
    try:
        for page in options.pages:
            if not page.is_file():
                print(f"{page}: no such file")
                failed = True
                continue
            complaints, summary = inspect(browser, page, options)
            for complaint in complaints:
                print(f"{page}: {complaint}")
            print(f"{page}: {'FAILED' if complaints else 'ok'}, {summary}")
            failed = failed or bool(complaints)
    finally:
        browser.close()
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
