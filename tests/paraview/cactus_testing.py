# SPDX-License-Identifier: BSD-3-Clause
"""What the tests in this folder share: VTK's errors as failures, a folder of one's own, and the judges in tests/tools.

VTK reports an error and goes on; neither pvpython nor an exception tells of it. CactusTestCase watches VTK's output, so that a test
fails by every error and warning that it did not ask for with assertError.
"""

import contextlib
import glob
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

from paraview import servermanager, simple
from paraview.vtk.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkLogger, vtkOutputWindow
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

_ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Where the programs are that the build has made: CTest says it; by hand, they are where ./cactus test has built them.
_TOOLS = os.environ.get("CACTUS_TOOLS") or os.path.join(_ROOT, "build", "release", "bin")
_REPORT = re.compile(r"(ERROR|Warning|Generic Warning): In ")
# The pipeline's own remark after a filter has reported what is wrong.
_FOLLOW_UP = re.compile(r"returned failure for request|Failed to execute|Could not create writer")

# What growth says of fibres that come straight from their source, where a test is about something else.
UNPARTED = r"the optimiser has not parted these fibres"

# What SubstrateWriter says of substrates as small as those of tests, where a test is about something else.
LEAVING = r"of the walkers of mcdc/extra\.conf leave the substrate|no room outside the fibres in the middle of the substrate for walkers of mcdc/extra\.conf"


def kill_at(process, words):
    """Reads what a job says, one of whose processes has printed its number ("process N"), and kills that one at the line with these words."""
    number = None
    for line in process.stdout:
        if line.startswith("process"):
            number = int(line.split()[1])
        if words in line:
            os.kill(number, signal.SIGKILL)
            break
    process.stdout.read()


def environment_of_its_own():
    """That of this process for one that is a run of MPI of its own: without what MPI has added, with how this run was set up."""
    kept = ("OMPI_MCA_rmaps", "OMPI_MCA_mpi", "OMPI_ALLOW", "PRTE_MCA_rmaps")
    return {name: value for name, value in os.environ.items() if name.startswith(kept) or not name.startswith(("PMIX_", "OMPI_", "PRTE_"))}


class CactusTestCase(unittest.TestCase):
    """Base class of all tests here. `self.folder` is an empty folder that goes away with the test. A warning in which `expected` (a
    regular expression) is found is none: what the inputs of a whole class bring about. Nor is one in which `usual` is found."""

    expected = None
    usual = LEAVING

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="cactus-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        self._messages = []

        def remember(window, event, text):
            isExpected = any(pattern is not None and re.search(pattern, text) for pattern in (self.expected, self.usual))
            if _REPORT.match(text) and not isExpected:  # Python's own stderr comes this way, too
                self._messages.append(text.strip())

        remember.CallDataType = VTK_STRING
        window = vtkOutputWindow.GetInstance()
        for event in ("ErrorEvent", "WarningEvent"):
            self.addCleanup(window.RemoveObserver, window.AddObserver(event, remember))

    def tearDown(self):
        # Views first: a render window that lives until Python ends takes the process down with it.
        for view in simple.GetViews():
            simple.Delete(view)
        for proxy in list(simple.GetSources().values()):
            simple.Delete(proxy)
        if self._messages:
            self.fail("VTK reported:\n" + "\n".join(self._messages))

    @contextlib.contextmanager
    def assertError(self, pattern):
        """Exactly one error, or one exception, is reported inside, and `pattern` is found in it (a regular expression)."""
        before = self._messages
        self._messages = []
        verbosity = vtkLogger.GetCurrentVerbosityCutoff()
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
        raised = []
        try:
            yield
        except RuntimeError as error:  # how paraview.simple speaks of a writer that failed
            raised = [str(error)]
        finally:
            vtkLogger.SetStderrVerbosity(verbosity)
            messages = [message for message in self._messages if not _FOLLOW_UP.search(message)]
            self._messages = before
        messages = messages or raised
        self.assertEqual(len(messages), 1, f"one error was expected, of {pattern!r}; reported: {messages}")
        self.assertRegex(messages[0], pattern)


def main():
    """Runs the tests of the calling script. On success it returns: in pvbatch the other ranks wait for the script's regular end."""
    if not unittest.main(module="__main__", exit=False, verbosity=2).result.wasSuccessful():
        sys.stdout.flush()
        sys.exit(1)


def fetch(proxy, port=0):
    """The output of a proxy as a VTK data object, after an update."""
    output = servermanager.OutputPort(proxy, port)
    output.UpdatePipeline()
    return servermanager.Fetch(proxy, idx=port)


def pixels(view):
    """The view as rows, columns and red, green, blue."""
    simple.Render(view)
    grab = vtkWindowToImageFilter()
    grab.SetInput(view.GetRenderWindow())
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[:, :, :3].astype(int)


def produce(data):
    """A source whose output is the given VTK data object, for inputs that no filter would make."""
    producer = simple.PVTrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    return producer


def switches_of(one):
    """(property, whether its opposite is meant, value) of what switches a property of the XML on: of several values the first."""
    found = [(switch, switch.get("value", switch.get("values"))) for switch in one.findall("Hints//PropertyWidgetDecorator")]
    return [(switch.get("property"), switch.get("inverse") == "1", values.split(" ")[0]) for switch, values in found if values is not None]


def proxies():
    """(group, XML element) of each proxy that the plugin describes, as ParaView reads it."""
    for path in sorted(glob.glob(os.path.join(_TOOLS, os.pardir, "xml", "*.xml"))):
        for group in ElementTree.parse(path).getroot().findall("ProxyGroup"):
            yield from ((group.get("name"), element) for element in group if element.tag.endswith("Proxy"))


def make(element, data):
    """The source or filter that an XML element describes, on inputs that hold `data`: {input's name or VTK class: data object}."""
    inputs = {}
    for port in element.findall("InputProperty"):
        if port.find("Hints/Optional") is None:
            name = port.get("name")
            inputs[name] = produce(data.get(name) or data[port.find("DataTypeDomain/DataType").get("value")])
    return getattr(simple, element.get("name"))(**inputs)


def judged(program, *arguments):
    """The JSON that one of the programs in tests/tools prints."""
    path = os.path.join(_TOOLS, program)
    done = subprocess.run([path, *arguments], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{program} failed on {arguments[-1]}: {done.stderr}")
    return json.loads(done.stdout)


def mesh_oracle(folder, *arguments):
    """What the independent checker finds in a folder of PLY or OFF files; see tests/tools/mesh_oracle.cpp."""
    return judged("cactus_mesh_oracle", *arguments, folder)


def random_walk(folder, **options):
    """What becomes of walkers in a substrate folder; see tests/tools/random_walk.cpp."""
    arguments = [word for name, value in options.items() for word in (f"--{name}", repr(value))]
    return judged("cactus_random_walk", *arguments, folder)
