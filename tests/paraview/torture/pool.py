# SPDX-License-Identifier: BSD-3-Clause
"""Runs cases in other processes, each with a limit of time and memory, and knows which case ended or hung its process.

A worker is this test's own script, started with `--worker FD`: names of cases come in by its standard input, one a line, and answers
go out as lines of JSON.
"""

import json
import os
import queue
import resource
import select
import signal
import subprocess
import tempfile
import threading
import time
import traceback

START_SECONDS = 60  # for ParaView to start and the good data to be made, on a busy machine
PATIENCE = 6  # how much longer than its processor time a case may take, where others use the processors, too
PEAK_MEGABYTES = 2500  # that a case may take more than the process has when it starts


def work(answers, make):
    """The worker's life: cases in, faults out, until its standard input ends. `make()` gives what runs them: run(name) tells the faults,
    all_cases() which there are."""
    bench = make()
    with open("/proc/self/statm") as file:
        mapped = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (mapped + (PEAK_MEGABYTES << 20), resource.RLIM_INFINITY))

    def answer(**what):
        os.write(answers, (json.dumps(what) + "\n").encode())

    answer(ready=True)
    for line in os.fdopen(0):  # pvpython puts something of its own in the place of sys.stdin
        name = line.strip()
        if name == "list":
            answer(cases=bench.all_cases())
            continue
        os.write(2, f"--- {name}\n".encode())
        try:
            faults = bench.run(name)
        except Exception:  # the test's own
            faults = ["the test itself failed: " + traceback.format_exc()]
            bench.forget()
        answer(faults=faults, note=bench.note)
    bench.close()


class Worker:
    """A process that runs cases, and is started anew when one of them ends it."""

    def __init__(self, script):
        self.script, self.process, self.note = script, None, ""
        self.log = tempfile.TemporaryFile()

    def start(self):
        reader, writer = os.pipe()
        program = os.readlink("/proc/self/exe")
        environment = {**os.environ, "OMP_NUM_THREADS": "2", "PYTHONDONTWRITEBYTECODE": "1"}
        # What is freed goes back to the system, so that a limit of memory is met again and again.
        environment.update({"MALLOC_MMAP_THRESHOLD_": "65536", "MALLOC_TRIM_THRESHOLD_": "65536", "MALLOC_ARENA_MAX": "1"})
        self.log.truncate(0)
        self.log.seek(0)
        self.process = subprocess.Popen(
            [program, self.script, "--worker", str(writer)], stdin=subprocess.PIPE, stdout=self.log, stderr=self.log, pass_fds=[writer],
            env=environment, start_new_session=True,
        )
        os.close(writer)
        self.answers, self.rest = reader, b""
        if self.read(START_SECONDS) is None:
            raise RuntimeError("no worker comes up: " + self.tail())

    def stop(self):
        if self.process is None:
            return None
        self.process.stdin.close()
        try:
            code = self.process.wait(5)
        except subprocess.TimeoutExpired:
            self.process.kill()
            code = self.process.wait()
        os.close(self.answers)
        self.process = None
        return code

    def processor_seconds(self):
        """Processor time that the process has taken so far."""
        try:
            with open(f"/proc/{self.process.pid}/stat") as file:
                words = file.read().rsplit(")", 1)[1].split()
        except OSError:
            return 0.0
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")

    def read(self, seconds):
        """The next answer; None if the process has ended, or has taken more processor time (or much more time) before it answers."""
        end, most = time.monotonic() + PATIENCE * seconds, self.processor_seconds() + seconds
        while b"\n" not in self.rest:
            ready, _, _ = select.select([self.answers], [], [], 0.5)
            part = os.read(self.answers, 1 << 20) if ready else b""
            self.late = not ready
            if ready and not part or not ready and (time.monotonic() > end or self.processor_seconds() > most):
                return None
            self.rest += part
        line, self.rest = self.rest.split(b"\n", 1)
        return json.loads(line)

    def tail(self):
        """The last that the process has said."""
        self.log.seek(0)
        text = self.log.read().decode(errors="replace")
        text = text.rsplit("\n--- ", 1)[-1]
        return " | ".join(line.strip() for line in text.splitlines() if line.strip())[-600:]

    def ask(self, what, seconds):
        if self.process is None:
            self.start()
        self.process.stdin.write((what + "\n").encode())
        self.process.stdin.flush()
        return self.read(seconds)

    def run(self, name, seconds):
        """(faults, seconds taken) of a case."""
        if self.process is None:
            self.start()
        begin = time.monotonic()
        if name.startswith(("server/", "cold/")):  # which start processes of their own
            seconds += 30
        try:
            answer = self.ask(name, seconds)
        except BrokenPipeError:
            answer, self.late = None, False
        took = time.monotonic() - begin
        self.note = ""
        if answer is not None:
            self.note = answer["note"]
            return answer["faults"], took
        if self.late:
            os.killpg(self.process.pid, signal.SIGKILL)  # and what it has started
            self.stop()
            return [f"not done after {seconds:g} s of processor time, or {PATIENCE * seconds:g} s"], took
        said = self.tail()
        code = self.stop()
        ended = signal.Signals(-code).name if code is not None and code < 0 else f"exit {code}"
        return [f"the process ended ({ended}): {said}"], took


def chunks(names, size=25):
    """Cases of the same family and proxy together, so that good results are made once."""
    ordered = sorted(names, key=lambda name: (name.split("/")[1], name))
    return [ordered[i : i + size] for i in range(0, len(ordered), size)]


def run(script, names, seconds, workers, report=None):
    """{name: (faults, seconds taken)} of all cases."""
    pending = queue.Queue()
    for chunk in chunks(names):
        pending.put(chunk)
    results = {}

    def serve():
        worker = Worker(script)
        while True:
            try:
                chunk = pending.get_nowait()
            except queue.Empty:
                break
            for name in chunk:
                try:
                    results[name] = worker.run(name, seconds)
                except RuntimeError as error:
                    results[name] = ([str(error)], 0.0)
                if report:
                    report(name, *results[name], worker.note)
        worker.stop()

    threads = [threading.Thread(target=serve) for _ in range(workers)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    return results
