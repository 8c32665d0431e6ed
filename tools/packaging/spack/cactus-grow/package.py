# SPDX-License-Identifier: BSD-3-Clause
"""cactus-grow for Spack: spack repo create REPO, put this folder into REPO/packages, then, in the sources,
spack dev-build cactus-grow@0.2.0"""

from spack.package import *


class CactusGrow(CMakePackage):
    """Grows synthetic white-matter substrates from a recipe, without ParaView."""

    homepage = "https://doi.org/10.3389/fninf.2023.1208073"

    license("BSD-3-Clause")

    version("0.2.0")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("eigen@3.3:")
    depends_on("nlohmann-json@3.9:")
    depends_on("random123")
    depends_on("libzip")
    depends_on("llvm-openmp")
    depends_on("openssl@1.1:")
    depends_on("xxhash@0.8:")
    depends_on("zlib-api")

    def cmake_args(self):
        return ["-DCACTUS_BUILD_PLUGIN=OFF", "-DCACTUS_BUILD_TESTS=OFF", f"-DRANDOM123_INCLUDE_DIR={self.spec['random123'].prefix.include}"]

    def test_version(self):
        """the command runs"""
        which(self.prefix.bin.join("cactus-grow"))("--version")
