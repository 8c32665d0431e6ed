#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# build.sh: in a container of Debian 12 with the sources in /cactus: cactus-grow into /opt/cactus.
set -eu
export DEBIAN_FRONTEND=noninteractive
apt-get update
apt-get install --yes --no-install-recommends cmake ninja-build g++ libeigen3-dev libomp-dev librandom123-dev libxxhash-dev libssl-dev libzip-dev zlib1g-dev nlohmann-json3-dev
cmake -S /cactus -B /tmp/build -G Ninja -DCMAKE_BUILD_TYPE=Release -DCACTUS_BUILD_PLUGIN=OFF -DCACTUS_BUILD_TESTS=OFF
cmake --build /tmp/build
cmake --install /tmp/build --prefix /opt/cactus --strip
