# SPDX-License-Identifier: BSD-3-Clause
"""launcher.py: how ./cactus configures builds, by programs that stand in for CMake and the others; it builds nothing."""

import os
import shutil
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOR_CI = ("CACTUS_WARNINGS_AS_ERRORS",)
STAND_INS = {
    "clang-format": "echo clang-format version 15.0.0",
    "cmake": """[ "$1" = --preset ] || exit 0
echo cmake "$@" >>log
mkdir -p build/$2
touch build/$2/build.ninja build/$2/CMakeCache.txt
cd build/$2
shift 2
for word; do
  name=${word#-D}
  sed -i "/^${name%=*}:/d" CMakeCache.txt
  echo "${name%=*}:BOOL=${name#*=}" >>CMakeCache.txt
done""",
    "ctest": "echo ctest",
    "dpkg-query": "echo installed",
    "mpiexec": 'echo mpiexec "$@"',
    "pvserver": 'echo pvserver "$@"',
}


class Launcher(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="cactus-launcher-test-")
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copy(os.path.join(ROOT, "cactus"), self.folder)
        for name, text in STAND_INS.items():
            path = os.path.join(self.folder, "programs", name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(f"#!/bin/sh\n{text}\n")
            os.chmod(path, 0o755)

    def cactus(self, *words, **variables):
        """What was said, and how CMake was called meanwhile."""
        environment = {name: value for name, value in os.environ.items() if name != "CI"}
        environment["PATH"] = os.path.join(self.folder, "programs") + os.pathsep + environment["PATH"]
        log = os.path.join(self.folder, "log")
        open(log, "w", encoding="utf-8").close()
        done = subprocess.run([os.path.join(self.folder, "cactus"), *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              check=True, cwd=self.folder, env={**environment, **variables})
        with open(log, encoding="utf-8") as file:
            return done.stdout, file.read().splitlines()

    def test_a_users_build_is_not_that_for_continuous_integration(self):
        on, off = (" ".join(f"-D{name}={value}" for name in FOR_CI) for value in ("ON", "OFF"))
        self.assertEqual(self.cactus("build", CI="true")[1], [f"cmake --preset release -DCACTUS_BUILD_TESTS=OFF {on}"])
        self.assertEqual(self.cactus("build", CI="true")[1], [])
        self.assertEqual(self.cactus("build")[1], [f"cmake --preset release {off}"])
        self.assertEqual(self.cactus("build")[1], [])

    def test_a_server_runs_on_as_many_ranks_as_asked(self):
        self.cactus("build")
        for words, wanted in (((), "pvserver --server-port=9"), (("-np", "3"), "mpiexec -n 3 pvserver --server-port=9")):
            self.assertEqual(self.cactus("pvserver", *words, "--server-port=9", DISPLAY=":1")[0].splitlines()[-1], wanted)

    def test_a_check_of_nothing_is_none(self):
        self.assertEqual(self.cactus("check", "style"), ("cactus: style is judged with clang 14, which is not here: left out\n", []))


if __name__ == "__main__":
    unittest.main()
