"""Ctrl-C ends every long call within a second, writes nothing, and leaves Python as it was."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

CALLS = {
    "fit": "recoil.fit('misfit.toml', replicates=1000000, threads=1)",
    "fit on all cores": "recoil.fit('misfit.toml', replicates=1000000)",
    "posterior": "[recoil.fit('uncertain', uncertainty={'posterior': True}, replicates=0, threads=1)"
                 " for _ in range(1000)]",
    "coverage": "recoil.coverage('mine.toml', 100000, replicates=199, threads=1)",
    "diagnose": "[quick.diagnose(threads=1) for _ in range(1000)]",
    "simulate": "[quick.simulate(velocities, 4.0, gradient=True) for _ in range(1000)]",
}

# Says when it starts, catches the interrupt, says how long that took, and goes on working.
PROGRAM = """
import signal, sys, time
import numpy
import recoil
quick = recoil.fit("misfit.toml", replicates=0)
velocities = numpy.linspace(1.0, 20.0, 3000000)
before = quick.json
print("ready", flush=True)
try:
    {call}
    print("never")
except KeyboardInterrupt:
    print("stopped", flush=True)
print(recoil.fit("misfit.toml", replicates=0).json == before)
"""


def worked(pid):
    """Processor time of a process so far [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def wait_until_worked(pid, seconds):
    until = worked(pid) + seconds
    while worked(pid) < until:
        time.sleep(0.01)


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends_it_within_a_second(here, name):
    before = sorted(p.name for p in here.iterdir())
    program = subprocess.Popen([sys.executable, "-c", PROGRAM.replace("{call}", CALLS[name])],
                               cwd=here, stdout=subprocess.PIPE, text=True, env=dict(os.environ))
    try:
        assert program.stdout.readline() == "ready\n"
        wait_until_worked(program.pid, 1.0)
        program.send_signal(signal.SIGINT)
        begun = time.monotonic()
        assert program.stdout.readline() == "stopped\n"
        # A second, and as much again for a machine that has other things to do.
        assert time.monotonic() - begun < 2.0
        assert program.stdout.read() == "True\n"
        assert program.wait(timeout=60) == 0
    finally:
        program.kill()
        program.wait()
        program.stdout.close()
    assert sorted(p.name for p in here.iterdir()) == before


def test_a_handler_of_ones_own_is_asked(here):
    """Who turns Ctrl-C into something else gets that; who ignores it is not stopped."""
    code = """
import signal
import recoil
seen = []
signal.signal(signal.SIGALRM, lambda *_: seen.append("alarm"))
signal.setitimer(signal.ITIMER_REAL, 0.2)
recoil.fit("misfit.toml", replicates=2000, threads=1)
print(seen)
class Mine(Exception): pass
def handler(*_):
    raise Mine
signal.signal(signal.SIGALRM, handler)
signal.setitimer(signal.ITIMER_REAL, 0.2)
try:
    recoil.fit("misfit.toml", replicates=1000000, threads=1)
except Mine:
    print("mine")
"""
    done = subprocess.run([sys.executable, "-c", code], cwd=here, text=True, capture_output=True,
                          timeout=120)
    assert done.stdout.splitlines() == ["['alarm']", "mine"], done.stderr
