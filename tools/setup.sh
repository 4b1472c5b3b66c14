#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs what the project needs from Debian 12. The only place that installs. Safe to run again;
# works as root or with sudo.
set -euo pipefail

packages=(
  # build
  g++ cmake ninja-build ccache git pkg-config ca-certificates
  # libraries
  libeigen3-dev libceres-dev libgoogle-glog-dev libgflags-dev liblzf-dev
  libtbb-dev libembree-dev libssl-dev nlohmann-json3-dev libboost-dev
  # tests
  libgtest-dev libgmock-dev libnanoflann-dev libpcl-dev
  # figures
  python3 python3-matplotlib python3-numpy
)
for option in "$@"; do
  case "$option" in
    --with-checks) packages+=(clang-format clang-tidy) ;;
    --with-comparison) packages+=(python3-scipy) ;;
    --with-benchmarks) packages+=(libbenchmark-dev libopen3d-dev) ;;
    --with-latex) packages+=(texlive-latex-base texlive-pictures poppler-utils) ;;
    *)
      echo "setup.sh: unknown option $option; expected --with-benchmarks, --with-checks," \
        "--with-comparison or --with-latex" >&2
      exit 1
      ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
    missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  echo "setup: all ${#packages[@]} packages are installed"
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "setup.sh: must install ${missing[*]}; run it as root or install sudo" >&2
    exit 1
  }
  as_root=(sudo)
fi
echo "setup: installing ${missing[*]}"
"${as_root[@]}" apt-get update -q
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
  apt-get install -y -q --no-install-recommends "${missing[@]}"
