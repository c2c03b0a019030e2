#!/usr/bin/env python3
"""Fits an example on build/web/recoil.html in headless Firefox, opened from the disk, and compares what
the page prints with what the program prints. Firefox is driven by its own protocol, Marionette. Exit
status 1 if the words differ.

usage: in_firefox.py
"""

import json
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

root = pathlib.Path(__file__).resolve().parent.parent.parent
EXAMPLE = "wall1990-molybdenum"
PORT = 2828  # Marionette's own
LIMIT = 300.0  # [s]


class Firefox:
    """Firefox with Marionette: messages are `length:[type, id, command, parameters]`."""

    def __init__(self):
        self.profile = tempfile.mkdtemp(prefix="recoil-firefox-")
        self.process = subprocess.Popen(
            ["firefox-esr", "--headless", "--marionette", "--no-remote", "--profile", self.profile],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        end = time.time() + LIMIT
        while True:
            try:
                self.socket = socket.create_connection(("127.0.0.1", PORT), timeout=LIMIT)
                break
            except OSError:
                if time.time() > end:
                    raise
                time.sleep(0.5)
        self.buffer = b""
        self.counter = 0
        self.receive()  # its greeting
        self.call("WebDriver:NewSession", {"capabilities": {"alwaysMatch": {}}})

    def receive(self):
        while b":" not in self.buffer:
            self.buffer += self.socket.recv(65536)
        size, rest = self.buffer.split(b":", 1)
        while len(rest) < int(size):
            rest += self.socket.recv(65536)
        self.buffer = rest[int(size):]
        return json.loads(rest[:int(size)])

    def call(self, command, parameters):
        self.counter += 1
        sent = json.dumps([0, self.counter, command, parameters]).encode()
        self.socket.sendall(str(len(sent)).encode() + b":" + sent)
        _, _, error, result = self.receive()
        if error:
            raise RuntimeError(f"{command}: {error['message']}")
        return result

    def do(self, script):
        return self.call("WebDriver:ExecuteScript", {"script": script, "args": []})["value"]

    def wait(self, condition):
        end = time.time() + LIMIT
        while not self.do(f"return Boolean({condition})"):
            if time.time() > end:
                raise RuntimeError(f"{condition} did not come true")
            time.sleep(0.2)

    def close(self):
        self.process.terminate()
        self.process.wait()
        shutil.rmtree(self.profile, ignore_errors=True)


def main():
    firefox = Firefox()
    try:
        firefox.call("WebDriver:Navigate", {"url": (root / "build/web/recoil.html").as_uri()})
        firefox.wait("document.querySelector('#materials option') && !document.getElementById('start').disabled")
        firefox.do(f"const f = document.getElementById('example'); f.value = '{EXAMPLE}'; f.dispatchEvent(new Event('change'));")
        firefox.wait("!document.getElementById('start').disabled && document.getElementById('go').getClientRects().length")
        firefox.do("document.getElementById('start').click()")
        firefox.wait("document.body.dataset.seconds")
        tab = firefox.do("return document.getElementById('text').textContent")
        seconds = float(firefox.do("return document.body.dataset.seconds"))
    finally:
        firefox.close()
    with tempfile.TemporaryDirectory() as folder:
        program = subprocess.run([str(root / "build/release/recoil"), "fit", f"fits/{EXAMPLE}.toml", "--out", folder + "/pages",
                                  "--replicates", "199"], cwd=root, capture_output=True, text=True, check=True).stdout
    same = tab.rstrip("\n") == program.rstrip("\n")
    print(f"{EXAMPLE} in Firefox: {seconds:.1f} s; " + ("the words of the program" if same else f"differs:\n{tab}\n---\n{program}"))
    return 0 if same else 1


if __name__ == "__main__":
    sys.exit(main())
