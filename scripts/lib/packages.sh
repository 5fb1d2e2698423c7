# Debian packages that Portrait needs, and their installation. Sourced, not run.
# Complete on a Debian 12 that has nothing but git and a shell; what is there already is left alone.

build_packages=(
  g++ cmake ninja-build pkgconf            # compiler and build
  libeigen3-dev libhdf5-dev libfmt-dev libxxhash-dev zlib1g-dev
  libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libcpp-httplib-dev
)
picture_packages=(gnuplot-nox)
# The page of `portrait serve` and its tests; nodejs from elsewhere, which brings its own npm, is left alone.
page_packages=()
command -v npm >/dev/null || page_packages+=(nodejs npm)
command -v chromium >/dev/null || page_packages+=(chromium)
test_packages=(
  libgtest-dev librapidcheck-dev           # unit and property tests
  libbenchmark-dev                         # benchmarks, each of which a test runs once
  doxygen                                  # the API documentation without warnings
  python3 python3-xarray python3-netcdf4 python3-h5netcdf python3-h5py netcdf-bin  # portraits read by others
  python3-matplotlib octave octave-netcdf  # and examples/
  munge slurmctld slurmd slurm-client openmpi-bin  # a cluster of one machine
  zsh                                      # its completion
  dpkg-dev file                            # the Debian package that cpack makes
  strace                                   # killing a sweep at a chosen system call
)
# The thread sanitizer with what it must know of OpenMP.
thread_packages=(clang libclang-rt-14-dev libomp-dev)

say() { printf '==> %s\n' "$*"; }

is_installed() { [ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]; }

# install_missing PACKAGE...: installs what is not there, as root or through sudo
install_missing() {
  local missing=() package
  for package in "$@"; do is_installed "$package" || missing+=("$package"); done
  [ ${#missing[@]} -eq 0 ] && return
  command -v apt-get >/dev/null || {
    echo "Portrait needs these Debian packages, and there is no apt-get here. Install what they are called on this system:" >&2
    echo "  ${missing[*]}" >&2
    exit 1
  }
  say "Installing ${#missing[@]} Debian packages: ${missing[*]}"
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "Portrait needs these packages, and neither root nor sudo is at hand to install them. Ask for:" >&2
      echo "  apt-get install ${missing[*]}" >&2
      exit 1
    }
    as_root=(sudo)
  fi
  "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null || {
    echo "Installing failed: is the network there, and is this Debian 12 or newer?" >&2
    exit 1
  }
}

# build PRESET [TARGET...]: configures when needed, then builds the targets, or those of the preset
build() {
  local preset=$1
  shift
  if [ ! -f "build/$preset/build.ninja" ]; then
    say "Configuring preset $preset"
    cmake --preset "$preset" --log-level=WARNING >/dev/null
  fi
  say "Building preset $preset"
  cmake --build --preset "$preset" ${1:+--target "$@"} -- --quiet
}
