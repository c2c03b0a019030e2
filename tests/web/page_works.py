#!/usr/bin/env python3
"""Uses build/web/recoil.html as a person does, in headless Chromium, opened from the disk: on a wide
screen, and on a phone in dark mode. Exit status 1 if something is not as it has to be.

usage: page_works.py AXE [PICTURES]   AXE: axe.min.js of axe-core; PICTURES: folder for screenshots
"""

import pathlib
import sys
import tempfile
import time
import types

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests/web"))
from tab import PAGE, Tab, chromium  # noqa: E402

TABLE = "V [m/s],e,e_sd\n2,0.5,0.02\n3.1,0.62,0.02\n4.2,0.70,0.02\n6,0.75,0.02\n9.5,0.78,0.02\n"
DROPS = "drop (cm),rebound (cm)\n30,20\n30,19.6\n60,40\n60,39\n90,58\n"
SCREENS = {"wide": (1280, 900, False), "phone": (390, 844, True)}


class Person:
    """What a person does with the page, and what is wrong in what they see."""

    def __init__(self, name, axe, pictures):
        self.name, self.axe, self.pictures = name, axe, pictures
        width, height, dark = SCREENS[name]
        self.width = width
        self.tab = Tab(width, height, dark)
        self.wrong = []

    def do(self, script):
        return self.tab.evaluate(f"(async () => {{ {script} }})()")

    def expect(self, what, holds):
        if not holds:
            self.wrong.append(f"{self.name}: {what}")

    def wait(self, condition="!document.getElementById('start').disabled && !worker", limit=90):
        end = time.time() + limit
        while not self.do(f"return Boolean({condition})"):
            if time.time() > end:
                raise RuntimeError(f"{self.name}: {condition} did not come true")
            time.sleep(0.1)

    def give(self, path):
        """Drops a file of the disk on the page; on a phone, chooses it."""
        call, session = self.tab.browser.call, self.tab.session
        if self.name == "phone":
            document = call("DOM.getDocument", session)["root"]["nodeId"]
            field = call("DOM.querySelector", session, nodeId=document, selector="#choose")["nodeId"]
            call("DOM.setFileInputFiles", session, nodeId=field, files=[str(path)])
        else:
            self.do("window.scrollTo(0, 0)")
            for kind in ("dragEnter", "dragOver", "drop"):
                call("Input.dispatchDragEvent", session, type=kind, x=60, y=200,
                     data={"items": [], "files": [str(path)], "dragOperationsMask": 1})
        self.wait(f"table[0] === '{path.name}' && !worker")
        self.wait()

    def set(self, field, value):
        self.do(f"const f = document.getElementById('{field}'); f.value = '{value}'; f.dispatchEvent(new Event('change'));")
        self.wait()

    def click(self, button):
        self.do(f"document.getElementById('{button}').click()")

    def shown(self, element):
        return self.do(f"const e = document.getElementById('{element}'); return Boolean(e && e.getClientRects().length)")

    def text(self, element):
        return self.do(f"return document.getElementById('{element}').innerText")

    def look(self, stage):
        """The checks of every stage: axe, the width, a picture."""
        browser, session = self.tab.browser, self.tab.session
        for found in chromium.findings_of_axe(browser, session, types.SimpleNamespace(axe=self.axe)):
            self.wrong.append(f"{self.name}, {stage}: {found}")
        wide = self.do("return document.scrollingElement.scrollWidth")
        self.expect(f"{stage}: {wide} px wide", wide <= self.width + 1)
        if self.pictures:
            height = self.do("return document.scrollingElement.scrollHeight")
            chromium.take_pictures(browser, session, self.pictures / stage, self.name, self.width, height)

    def tabs_through(self):
        """The ids of what the Tab key reaches."""
        seen = []
        self.do("document.activeElement.blur()")
        for _ in range(40):
            for kind in ("keyDown", "keyUp"):
                self.tab.browser.call("Input.dispatchKeyEvent", self.tab.session, type=kind, key="Tab", code="Tab",
                                      windowsVirtualKeyCode=9)
            seen.append(self.do("return document.activeElement.id"))
        return set(seen)


def use(person):
    do, expect = person.do, person.expect
    person.look("first")
    # An example, by one choice.
    person.set("example", "wall1990-molybdenum")
    person.click("start")
    person.wait("document.body.dataset.seconds")
    person.wait()
    expect("the example shows no text", "C_H" in person.text("text"))
    expect("the example has no picture", do("await $('picture').decode(); return $('picture').naturalWidth > 0"))
    expect("no fit.json", do("return files.has('pages/fit.json')"))
    seconds = float(do("return document.body.dataset.seconds"))
    print(f"{person.name}: first result of wall1990-molybdenum after {seconds:.1f} s", flush=True)
    person.look("example")
    reached = person.tabs_through()
    expect(f"the Tab key reaches {sorted(reached)}", {"choose", "folder", "example", "replicates", "start", "whole",
                                                       "text", "commands"} <= reached)
    # The page of the program.
    person.click("whole")
    person.wait("!$('page').hidden", 300)
    person.wait()
    inner = do("return $('page').srcdoc")
    expect("the page has no figure or no diagnosis", "<svg" in inner and "diagnosis" in inner)
    expect("the page is not saved", "wall1990-molybdenum.html" in person.text("save"))
    person.look("page")
    # A table of one's own: only what it lacks is asked.
    with tempfile.TemporaryDirectory() as folder:
        table, drops = pathlib.Path(folder, "mine.csv"), pathlib.Path(folder, "drops.csv")
        table.write_text(TABLE)
        drops.write_text(DROPS)
        person.give(table)
        expect("fields of the table", [person.shown(f"{f}-row") for f in ("diameter", "particle", "surface", "ball", "map")] ==
               [True, True, True, False, False])
        person.set("diameter", "4.9um")
        person.set("particle", "polystyrene")
        person.set("surface", "unobtainium")
        person.look("asked")
        person.click("start")
        person.wait("document.getElementById('surface-error').innerText")
        person.wait()
        expect("a wrong material is not marked", do("return $('surface').getAttribute('aria-invalid') === 'true'"))
        person.look("error")
        person.set("surface", "silicon")
        person.set("replicates", "0")
        person.click("start")
        person.wait("files.has('pages/figure.svg')")
        person.wait()
        expect("the table is not fitted", do("return files.has('pages/fit.json') && files.has('mine/points.csv')"))
        # Drops of a ball: its name is enough.
        person.give(drops)
        expect("fields of the drops", person.shown("ball-row"))
        person.set("ball", "golf")
        expect("a golf ball needs a material", not person.shown("particle-row"))
        person.click("start")
        person.wait("!$('text').hidden && $('text').innerText.includes('e')")
        person.wait()
        expect("no mean e", "0.8" in person.text("text"))
        person.look("ball")
    # Stop ends a long command at once.
    person.set("example", "wall1990-molybdenum")
    person.set("replicates", "1999")
    person.click("start")
    person.wait("worker && $('state').innerText.includes('left')")
    expect("no time left is shown", "left" in person.text("state"))
    person.click("stop")
    person.wait(limit=5)
    for complaint in chromium.complaints_in(person.tab.browser.events, PAGE.resolve().as_uri()):
        person.wrong.append(f"{person.name}: {complaint}")
    person.tab.browser.close()
    return person.wrong


def main():
    axe = pathlib.Path(sys.argv[1])
    pictures = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    wrong = [line for name in SCREENS for line in use(Person(name, axe, pictures))]
    print("\n".join(wrong) or "The page works on both screens.")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
