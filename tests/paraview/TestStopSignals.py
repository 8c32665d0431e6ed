# SPDX-License-Identifier: BSD-3-Clause
# ctest-timeout: 600
"""Ctrl-C, kill and the end of a batch job while a filter is at work: it stops in good order, with one message, and the next run goes on."""

import contextlib
import glob
import os
import signal
import subprocess
import time

from cactus_testing import CactusTestCase, environment_of_its_own, fetch, main, produce
from chain import Chain
from folder_content import files
from paraview.simple import SubstrateWriter
from surfaces import two_tubes

# Makes a substrate, and is stopped by a signal in the middle. With several ranks it is the first that runs this.
SCRIPT = """
import os, signal, sys
from paraview.simple import *
folder, number = sys.argv[1], int(sys.argv[2])
if len(sys.argv) > 3:
    signal.signal(number, lambda *_: print("heard", flush=True))
fibres = CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=5, GrownFibreVolumeFraction=0.85))
made = SubstrateProduction(Input=OutputPort(fibres, 0), FolderName=folder, NumberOfThreads=1, Format="Surfaces alone")
filter = made.GetClientSideObject()
def stop(*_):
    if number and 0.5 < filter.GetProgress() < 1: # VTK says 1 when the work is done
        os.kill(os.getpid(), number)
filter.AddObserver("ProgressEvent", stop)
made.UpdatePipeline()
print("end of the script", flush=True)
"""
HISTORY = """
import os, signal, sys
from paraview.simple import *
if len(sys.argv) > 2:
    signal.signal(signal.SIGTERM, lambda *_: print("heard", flush=True))
fibres = CapsuleOptimizer(Input=BundleInitializer(Border="Walls", Side=10, MeanDispersion=15, DispersionModel="Watson"), CheckpointFile=sys.argv[1])
filter = fibres.GetClientSideObject()
def stop(*_):
    if "iteration 20:" in str(filter.GetProgressText()):
        os.kill(os.getpid(), signal.SIGTERM)
filter.AddObserver("ProgressEvent", stop)
fibres.KeepHistory = 1
fibres.UpdatePipeline()
print("end of the script", flush=True)
"""
ACKNOWLEDGED = "CACTUS: stopping in good order"
KEPT = "stopped by the user, and what is finished is kept in {0}.work: Write, or the same script, goes on with it"


def wait_for_processes_with(argument):
    def have_it():
        for path in glob.glob("/proc/[0-9]*/cmdline"):
            with contextlib.suppress(OSError), open(path, "rb") as file:
                if argument.encode() in file.read().split(b"\0"):
                    return True
        return False

    while have_it():
        time.sleep(0.05)


class StopSignalsTest(CactusTestCase):
    def run_script(self, *launcher, folder, number=0, isHeard=False):
        path = os.path.join(self.folder, "script.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCRIPT)
        arguments = [folder, str(int(number)), *(["heard"] if isHeard else [])]
        done = subprocess.run([*launcher, path, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              env=environment_of_its_own())
        return done.returncode, done.stdout

    def assertStopped(self, folder, said):
        self.assertEqual(said.count(KEPT.format(folder)), 1, said)
        self.assertNotIn("Stack trace", said)
        self.assertFalse(os.path.exists(folder))
        self.assertTrue(os.path.exists(folder + ".work/journal"))

    def test_the_process_ends_unless_a_script_hears_of_it(self):
        whole = os.path.join(self.folder, "whole")
        self.assertEqual(self.run_script("pvpython", folder=whole)[0], 0)
        for launcher, number, isHeard in (("pvpython", signal.SIGINT, False), ("pvpython", signal.SIGINT, True),
                                          ("pvbatch", signal.SIGTERM, False)):
            with self.subTest(launcher=launcher, number=number, isHeard=isHeard):
                folder = os.path.join(self.folder, f"{launcher}-{int(number)}-{isHeard}")
                code, said = self.run_script(launcher, folder=folder, number=number, isHeard=isHeard)
                self.assertStopped(folder, said)
                self.assertEqual(code, 0 if isHeard else -number, said)
                self.assertEqual("heard\nend of the script" in said, isHeard, said)
                code, said = self.run_script(launcher, folder=folder)
                self.assertEqual(code, 0, said)
                self.assertEqual(files(folder), files(whole))

    def test_ranks_end_together(self):
        """Where one of them is told to, and where all are, as by Ctrl-C, whose last words mpiexec may not wait for."""
        folder = os.path.join(self.folder, "ranks")
        code, said = self.run_script("mpiexec", "-n", "2", "pvbatch", folder=folder, number=signal.SIGTERM)
        self.assertNotEqual(code, 0)
        self.assertStopped(folder, said)
        self.assertEqual(said.count(ACKNOWLEDGED), 1, said)
        code, said = self.run_script("pvbatch", folder=folder)
        self.assertEqual(code, 0, said)
        self.assertFalse(os.path.exists(folder + ".work"))
        path = os.path.join(self.folder, "all.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write(SCRIPT.replace("os.kill(os.getpid(), number)", "print('half', flush=True)").replace("Side=5", "Side=12"))
        folder = os.path.join(self.folder, "all")
        with subprocess.Popen(["mpiexec", "-n", "2", "pvbatch", path, folder, "1"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, env=environment_of_its_own()) as process:
            said = process.stdout.readline()
            while said and not said.endswith("half\n"):
                said += process.stdout.readline()
            process.send_signal(signal.SIGINT)
            said += process.stdout.read()
        self.assertNotEqual(process.returncode, 0)
        self.assertNotIn("Stack trace", said)
        self.assertLessEqual(said.count(ACKNOWLEDGED), 1, said)
        self.assertLessEqual(said.count("what is finished is kept"), 1, said)
        wait_for_processes_with(path)  # which mpiexec does not
        self.assertFalse(os.path.exists(folder))

    def test_a_run_that_offers_its_states_stops_too(self):
        """It is begun by a request for its times."""
        path, checkpoint = os.path.join(self.folder, "history.py"), os.path.join(self.folder, "run")
        with open(path, "w", encoding="utf-8") as file:
            file.write(HISTORY)
        for isHeard in (False, True):
            with self.subTest(isHeard=isHeard):
                done = subprocess.run(["pvpython", path, checkpoint, *(["heard"] if isHeard else [])], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                      text=True, env=environment_of_its_own())
                self.assertEqual(done.returncode, 0 if isHeard else -signal.SIGTERM, done.stdout)
                self.assertEqual("heard\nend of the script" in done.stdout, isHeard, done.stdout)
                self.assertEqual(done.stdout.count("stopped by the user"), 1, done.stdout)
                self.assertNotIn("Stack trace", done.stdout)
                os.remove(checkpoint)

    def test_what_is_written_stays(self):
        """A signal that comes with the last words on the folder, which is in its place."""
        heard, sent = [], []
        signal.signal(signal.SIGINT, lambda *_: heard.append(1))

        def stop(*_):
            if not sent:
                sent.append(1)
                os.kill(os.getpid(), signal.SIGINT)

        folder = os.path.join(self.folder, "substrate")
        writer = SubstrateWriter(Outer=produce(two_tubes()[1]), FolderName=folder, MinimumGap=10)  # which it has not
        writer.GetClientSideObject().AddObserver("WarningEvent", stop)
        table = fetch(writer)
        self.assertEqual(heard, [1])
        self.assertIn("manifest.json", os.listdir(folder))
        self.assertEqual(table.GetNumberOfRows(), 2)

    def test_kill_reaches_what_the_launcher_runs(self):
        """It is the same process, and its display goes with it."""
        root = os.path.realpath(os.path.join(os.path.dirname(__file__), "..", ".."))
        if os.path.realpath(os.environ.get("CACTUS_TOOLS", "")) != os.path.join(root, "build", "release", "bin"):
            self.skipTest("the launcher runs another build")
        with open(os.path.join(root, "build", "release", "CMakeCache.txt"), encoding="utf-8") as file:
            if ("CACTUS_WARNINGS_AS_ERRORS:BOOL=ON" in file.read()) != bool(os.environ.get("CI")):
                self.skipTest("the launcher would configure first")
        if "no work to do" not in subprocess.run(["ninja", "-n", "-C", os.path.join(root, "build", "release"), "CACTUS"], capture_output=True, text=True).stdout:
            self.skipTest("the launcher would build first")
        path = os.path.join(self.folder, "who.py")
        with open(path, "w", encoding="utf-8") as file:
            file.write("import os, time\nprint(os.getpid(), os.environ['XAUTHORITY'], flush=True)\ntime.sleep(300)\n")
        environment = {name: value for name, value in environment_of_its_own().items() if name not in ("DISPLAY", "XAUTHORITY")}
        with subprocess.Popen([os.path.join(root, "cactus"), "pvpython", path], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, env=environment) as process:
            number, authority = process.stdout.readline().split()
            self.assertEqual(number, str(process.pid))
            self.assertTrue(os.path.exists(authority))
            process.terminate()
        self.assertEqual(process.returncode, -signal.SIGTERM)
        end = time.monotonic() + 60
        while os.path.exists(authority) and time.monotonic() < end:
            time.sleep(0.1)
        self.assertFalse(os.path.exists(authority))

    def test_nothing_that_follows_is_begun(self):
        """The optimiser, which keeps its best state where the window stops it, has something to hand on."""
        heard = []
        signal.signal(signal.SIGINT, lambda *_: heard.append(1))
        chain = Chain(self.folder)
        for stage, following in ((chain.optimizer, chain.growth), (chain.growth, chain.surface), (chain.surface, chain.certificate)):
            with self.subTest(stage=stage.SMProxy.GetXMLName()):
                stage.NumberOfThreads = 1
                algorithm = stage.GetClientSideObject()

                def stop(*_):
                    if 0 < algorithm.GetProgress() < 1:
                        os.kill(os.getpid(), signal.SIGINT)

                observer = algorithm.AddObserver("ProgressEvent", stop)
                begun = []
                other = following.GetClientSideObject()
                watcher = other.AddObserver("ProgressEvent", lambda *_: begun.append(other.GetProgress()))
                heard.clear()
                with self.assertError("stopped by the user, and nothing is kept"):
                    following.UpdatePipeline()
                algorithm.RemoveObserver(observer)
                other.RemoveObserver(watcher)
                self.assertEqual(len(heard), 1)
                self.assertEqual([progress for progress in begun if 0 < progress < 1], [])
                stage.NumberOfThreads = 2
                following.UpdatePipeline()
                self.assertGreater(following.GetClientSideObject().GetOutputDataObject(0).GetNumberOfElements(0) +
                                   following.GetClientSideObject().GetOutputDataObject(0).GetNumberOfElements(6), 0)


main()
