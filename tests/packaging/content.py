# SPDX-License-Identifier: BSD-3-Clause
"""content.py FOLDER VERSION PARAVIEW: what is in the Debian package of FOLDER: all that a user needs, where Debian has it, for this
Debian's ParaView; lintian, where it is installed, is content; and the plugin that it holds is loaded by pvpython."""

import glob
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

FOLDER, VERSION, PARAVIEW = sys.argv[1:4]
ARCHITECTURE = subprocess.run(["dpkg", "--print-architecture"], capture_output=True, text=True, check=True).stdout.strip()
PACKAGE = os.path.join(FOLDER, f"cactus-paraview_{VERSION}_{ARCHITECTURE}.deb")


def output(*command, **options):
    return subprocess.run(command, capture_output=True, text=True, check=True, **options).stdout


def lists_plugins():
    """Whether this Debian's ParaView has a list of configurations which a package can add one to."""
    for path in glob.glob(f"/usr/lib/*/{PARAVIEW}/paraview.conf"):
        with open(path, encoding="utf-8") as file:
            return "/usr/share/paraview/plugins" in file.read().splitlines()
    return False


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix="cactus-package-")
        cls.addClassCleanup(shutil.rmtree, cls.root)
        output("dpkg-deb", "--extract", PACKAGE, cls.root)

    def one(self, pattern):
        found = glob.glob(os.path.join(self.root, pattern))
        self.assertEqual(len(found), 1, pattern)
        return found[0]

    def test_is_the_only_one(self):
        self.assertEqual(glob.glob(os.path.join(FOLDER, "*.deb")), [PACKAGE])

    def test_depends_on_this_paraview(self):
        depends = output("dpkg-deb", "--field", PACKAGE, "Depends")
        self.assertRegex(depends, rf"(^|, )paraview \(>= {PARAVIEW.split('-')[1]}")
        self.assertRegex(depends, r"(^|, )paraview \(<< ")
        for package in ("python3-paraview", "libomp5", "libxxhash0", "libssl3", "libzip", "libstdc\\+\\+6"):
            self.assertRegex(depends, rf"(^|, ){package}")
        self.assertNotIn("cactus", depends)

    def test_recommends_icons_for_this_window(self):
        icons = {"5": "libqt5svg5", "6": "qt6-svg-plugins"}
        for qt in re.findall(r"libqt(\d)core", output("dpkg-deb", "--field", PACKAGE, "Depends")):  # none without Qt's development files
            self.assertEqual(output("dpkg-deb", "--field", PACKAGE, "Recommends").strip(), icons[qt])

    def test_paraview_finds_the_plugin(self):
        configuration = self.one(f"usr/lib/*/{PARAVIEW}/plugins/cactus.plugins.xml")
        with open(configuration, encoding="utf-8") as file:
            said = file.read()
        self.assertIn('<Plugin name="CACTUS" auto_load="1"', said)
        # In the folder of ParaView's own plugins.
        place = "/" + os.path.relpath(configuration, self.root)
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(place), "paraview.plugins.xml")), place)
        with open(os.path.join(self.root, *self.found_by()), encoding="utf-8") as file:
            self.assertEqual(file.read(), said if lists_plugins() else place + "\n")

    @staticmethod
    def found_by():
        """The file by which ParaView finds the plugin."""
        return ("usr", "share", "paraview", "plugins") if lists_plugins() else ("usr", "bin", "paraview.conf")

    def test_everything_is_where_debian_has_it(self):
        for pattern in ("usr/bin/cactus-grow", "usr/share/man/man1/cactus-grow.1.gz", "usr/share/doc/cactus-paraview/copyright",
                        "usr/share/doc/cactus-paraview/changelog.gz", "usr/share/doc/cactus-paraview/README.md*",
                        "usr/share/doc/cactus-paraview/docs/cactus-grow.md*", "usr/share/doc/cactus-paraview/examples/recipes/bundle.json",
                        "usr/share/doc/cactus-paraview/tools/scripts/report.py"):
            self.one(pattern)
        self.assertEqual(sorted(os.listdir(self.root)), ["usr"])
        self.assertEqual(sorted(os.listdir(os.path.join(self.root, "usr"))), ["bin", "lib", "share"])
        self.assertEqual(sorted(os.listdir(os.path.join(self.root, "usr/bin"))), ["cactus-grow"] + ([] if lists_plugins() else ["paraview.conf"]))
        self.assertEqual(glob.glob(os.path.join(self.root, "usr/lib/*")), [self.one("usr/lib/*-linux-*")])

    def test_the_plugin_loads_and_needs_nothing_of_the_build(self):
        plugin = self.one(f"usr/lib/*/{PARAVIEW}/plugins/CACTUS/CACTUS.so")
        self.one(f"usr/lib/*/{PARAVIEW}/plugins/CACTUS/libCactusWindow.so")
        for library in [plugin, *glob.glob(os.path.join(os.path.dirname(plugin), "lib*.so"))]:
            # Found beside it, and nothing in a folder of the build.
            for line in output("ldd", library).splitlines():
                self.assertNotIn("not found", line)
                if "libCactus" in line:
                    self.assertIn(os.path.dirname(plugin), line)
        script = os.path.join(self.root, "script.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write("from paraview.simple import *\nimport cactus_sweep\nb = BundleInitializer(Side=5)\nb.UpdatePipeline()\nprint('fibres', b.GetDataInformation().GetNumberOfCells())\n")
        self.addCleanup(os.remove, script)
        environment = {**os.environ, "PV_PLUGIN_CONFIG_FILE": self.one(f"usr/lib/*/{PARAVIEW}/plugins/cactus.plugins.xml"), "PV_PLUGIN_PATH": ""}
        self.assertRegex(output("pvpython", script, env=environment), r"fibres [1-9]")
        self.assertIn(VERSION, output(os.path.join(self.root, "usr/bin/cactus-grow"), "--version"))

    def test_its_scripts_find_each_other(self):
        documents = os.path.join(self.root, "usr/share/doc/cactus-paraview")
        script = os.path.join(self.root, "imports.py")
        with open(script, "w", encoding="utf-8") as file:
            file.write(f"import sys\nsys.path[:0] = [{documents!r} + '/examples/figures', {documents!r} + '/tools/scripts']\nimport paper_figure, report, rerun, preview\nprint('found')\n")
        self.addCleanup(os.remove, script)
        self.assertIn("found", output("pvpython", script, env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}))

    @unittest.skipUnless(shutil.which("lintian"), "lintian is not installed")
    def test_lintian_is_content(self):
        done = subprocess.run(["lintian", "--fail-on", "error,warning", "--allow-root", "--tag-display-limit", "0", PACKAGE],
                              capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
