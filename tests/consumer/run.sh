#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# run.sh BUILD_DIR COMPILER FOLDER...: installs the build, and builds and runs the examples as a project
# that knows the installed package alone. What io and simulation need is hidden from that project:
# neither its commands nor what it includes or loads may name it. FOLDERs are those of core's headers.
set -euo pipefail
build=$1 compiler=$2
shift 2
examples=$(cd "$(dirname "$0")/../../examples" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
others='(^|[^a-z])(lib|l)?(pcl|vtk|embree|crypto|ssl|openssl|nlohmann|lzf)'
status=0
refuse() {  # refuse WHAT: fails if its input names a library of io or simulation.
  if sed "s#$work##g" | grep -iE "$others" | sort -u | grep .; then
    echo "FAILED: $1 must not name these"
    status=1
  fi
}

cmake --install "$build" --prefix "$work/prefix" >"$work/install.log"
hidden=()
for package in PCL embree OpenSSL nlohmann_json liblzf; do
  hidden+=("-DCMAKE_DISABLE_FIND_PACKAGE_$package=ON")
done
cmake -G Ninja -S "$examples" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" "${hidden[@]}" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_BUILD_TYPE=Release -Wno-dev >"$work/configure.log" 2>&1 ||
  { cat "$work/configure.log"; exit 1; }
cmake --build "$work/build"

ninja -C "$work/build" -t commands all | refuse "the compiler's and linker's commands"
for example in own_solver ceres_problem register_two_clouds landscape_of_two_clouds \
  covariance_of_two_clouds; do
  "$work/build/$example" | tail -1
  ldd "$work/build/$example" | refuse "the libraries of $example"
done

# All of core's headers, not only those that the examples include.
(cd "$work/prefix/include" && find "${@/#/icpscape/}" -name '*.h') |
  sed 's/.*/#include <&>/' >"$work/all.cc"
[ "$(wc -l <"$work/all.cc")" -gt 50 ]
command=$(ninja -C "$work/build" -t commands CMakeFiles/register_two_clouds.dir/register_two_clouds.cc.o)
includes=$(grep -oE -- '-(I|isystem) ?[^ ]+' <<<"$command")
# shellcheck disable=SC2086
"$compiler" -std=c++17 -M $includes "$work/all.cc" >"$work/headers"
refuse "core's headers" <"$work/headers"

# Who asks for the other parts gets them.
cat >"$work/all_parts.cmake" <<'PARTS'
cmake_minimum_required(VERSION 3.25)
project(all_parts LANGUAGES CXX)
find_package(icpscape REQUIRED COMPONENTS io simulation)
foreach(target residuals core io simulation)
  if(NOT TARGET icpscape::${target})
    message(FATAL_ERROR "icpscape::${target} was not found")
  endif()
endforeach()
PARTS
mkdir "$work/parts"
mv "$work/all_parts.cmake" "$work/parts/CMakeLists.txt"
cmake -S "$work/parts" -B "$work/parts/build" -DCMAKE_PREFIX_PATH="$work/prefix" -Wno-dev \
  >"$work/parts.log" 2>&1 || { cat "$work/parts.log"; status=1; }
"$work/prefix/bin/icpscape-list_metrics" >/dev/null
exit $status
