#!/usr/bin/env python3
"""Opens one page in headless Chromium and evaluates expressions in it, one after the other.

usage: evaluate_in_chromium.py PAGE.html EXPRESSIONS.json [--downloads DIR]

EXPRESSIONS.json is a list of JavaScript expressions; a promise is waited for. Their values are
printed as a JSON list. What the page downloads meanwhile is in DIR when this ends. Fails when an
expression throws, or when the page asks for anything but itself or complains on its console.
"""

import argparse
import json
import pathlib
import sys
import time

import open_in_chromium


def wait_for_downloads(browser, folder, begun):
    deadline = time.time() + open_in_chromium.TIME_LIMIT
    while time.time() < deadline:
        files = [f for f in folder.iterdir() if not f.name.endswith(".crdownload")]
        if len(files) >= begun and len(files) == len(list(folder.iterdir())):
            return
        browser.call("Browser.getVersion")
        time.sleep(0.05)
    raise RuntimeError("a download does not end")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("expressions", type=pathlib.Path)
    parser.add_argument("--downloads", type=pathlib.Path)
    options = parser.parse_args()
    program = open_in_chromium.installed_chromium()
    if program is None:
        print("Chromium is not installed (package chromium)", file=sys.stderr)
        return 2
    browser = open_in_chromium.Browser(program)
    try:
        if options.downloads:
            browser.call("Browser.setDownloadBehavior", behavior="allow",
                         downloadPath=str(options.downloads.resolve()), eventsEnabled=True)
        session, _ = open_in_chromium.open_page(browser, options.page, 1200, 900, False)
        values = []
        for expression in json.loads(options.expressions.read_text()):
            answer = browser.call("Runtime.evaluate", session, expression=expression,
                                  returnByValue=True, awaitPromise=True, userGesture=True)
            if "exceptionDetails" in answer:
                print(json.dumps(answer["exceptionDetails"])[:2000], file=sys.stderr)
                return 1
            values.append(answer["result"].get("value"))
        begun = sum(e.get("method") == "Browser.downloadWillBegin" for e in browser.events)
        if options.downloads:
            wait_for_downloads(browser, options.downloads, begun)
        address = options.page.resolve().as_uri()
        for complaint in open_in_chromium.complaints_in(browser.events, address):
            print(complaint, file=sys.stderr)
            return 1
        print(json.dumps(values))
    finally:
        browser.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
