#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the Debian packages that are missing, as root or with sudo; with none missing it touches nothing.
#   scripts/setup.sh          what building and testing need
#   scripts/setup.sh --ci     also what the checks of .ci/run need
set -euo pipefail

packages=(
  ccache
  cmake
  fonts-dejavu-core
  g++
  libassimp-dev
  libbenchmark-dev
  libcgal-dev
  libcli11-dev
  libembree-dev
  libexpat1-dev
  libfmt-dev
  libgmock-dev
  libgtest-dev
  libhdf5-dev
  libifcplusplus-dev
  libnova-dev
  libosd-dev
  libpng-dev
  libtbb-dev
  libtomlplusplus-dev
  libvtk9-dev
  ninja-build
  nlohmann-json3-dev
  python3
  python3-vtk9
)
if [ "${1:-}" = --ci ]; then
  packages+=(clang-format-14 clang-tidy-14)
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup: this is not a Debian system; install what libraries you have by the names in scripts/setup.sh" >&2
  exit 0
fi

installed=$(dpkg-query --show --showformat '${db:Status-Status} ${Package}\n' "${packages[@]}" 2>/dev/null || true)
missing=()
for package in "${packages[@]}"; do
  grep -qx "installed $package" <<<"$installed" || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: missing packages and no sudo; as root: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update --quiet
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install --yes --quiet --no-install-recommends "${missing[@]}"
