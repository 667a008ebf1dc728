# Shared by Allrun, Alltest and the scripts of tutorials and benchmarks. Sourced, with $root set to the repository's root.

# Open MPI as root, and more ranks than cores, must be allowed by name.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1

build=${CORPUSCLE_BUILD:-$root/build}

# Why apt cannot install packages without removing others, from what it says of a simulation; the packages that it would remove stand in $2.
explain_conflict() {
    local plan=$1 removed=$2
    echo "The packages are not installed, and nothing has been changed:"
    if [[ " $removed " == *" python3-paraview "* ]] ||
        dpkg-query -W -f='${Status}' python3-paraview 2>/dev/null | grep -q 'install ok installed'; then
        cat <<'TEXT'
  Debian's ParaView (python3-paraview) and the VTK that Corpuscle is built with (libvtk9-dev, which needs python3-vtk9) exclude each other: they cannot be
  on one machine at the same time. One of these ways is open:
    - build and run in a container, and look at the results with the ParaView of this machine:
          docker run -it -v "$PWD":/corpuscle -w /corpuscle debian:12 ./Allrun        (or podman, or a chroot made by debootstrap)
    - take ParaView from paraview.org, which needs no packages, in place of Debian's:
          sudo apt-get remove python3-paraview && ./Allrun
    - build on another machine: results are plain files, and renderCase draws them without ParaView
TEXT
    elif [ -n "$removed" ]; then
        echo "  apt would remove: $removed. If that is all right, remove them yourself (sudo apt-get remove $removed) and start again; if not,"
        echo "  build in a container: docker run -it -v \"\$PWD\":/corpuscle -w /corpuscle debian:12 ./Allrun"
    else
        echo "$plan" | grep -E '^E:|Depends:|Conflicts:|Breaks:|held' | sed 's/^/  /'
        echo "  Corpuscle needs the packages of Debian 12 in etc/packages; on another system build in a container:"
        echo "  docker run -it -v \"\$PWD\":/corpuscle -w /corpuscle debian:12 ./Allrun"
    fi
}

# Installs the packages of a list that are missing (etc/packages unless named), through sudo when not root. Never removes one.
install_packages() {
    local missing=() package
    while read -r package; do
        case $package in '' | '#'*) continue ;; esac
        dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
    done <"$root/etc/${1:-packages}"
    [ ${#missing[@]} -eq 0 ] && return 0
    echo "Installing: ${missing[*]}"
    local sudo=
    [ "$(id -u)" -eq 0 ] || sudo=sudo
    $sudo apt-get update -qq || true # without a network, packages of a local cache may do
    local plan removed possible=true
    plan=$(LC_ALL=C apt-get -s install --no-install-recommends "${missing[@]}" 2>&1) || possible=false
    removed=$(sed -n 's/^Remv \([^ ]*\).*/\1/p' <<<"$plan" | paste -sd ' ')
    if ! $possible || [ -n "$removed" ]; then
        explain_conflict "$plan" "$removed"
        return 1
    fi
    $sudo env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends --no-remove "${missing[@]}" >/dev/null
}

# configure_and_build [cmake options] -- [targets]
configure_and_build() {
    local options=()
    while [ $# -gt 0 ] && [ "$1" != -- ]; do options+=("$1"); shift; done
    [ $# -gt 0 ] && shift
    mkdir -p "$build"
    cmake -S "$root" -B "$build" -G Ninja "${options[@]}" >"$build/cmake.log" 2>&1 || { cat "$build/cmake.log"; return 1; }
    (set -o pipefail; cmake --build "$build" -- "$@" 2>&1 | build_progress "$build/build.log") ||
        { grep -E 'error|FAILED' "$build/build.log" || tail -n 40 "$build/build.log"; return 1; }
}

# build_progress LOG: keeps what ninja says in LOG and shows how far it is: on a terminal in one line that is written over, else in a line for each
# tenth and at least one a minute. A build of a few steps is silent.
build_progress() {
    local log=$1 line= part done=0 all=0 shown=0 width=0 status start=$SECONDS last=$SECONDS text
    : >"$log"
    while true; do
        status=0
        IFS= read -r -t 2 part || status=$?
        line+=$part
        if [ $status -eq 0 ]; then
            printf '%s\n' "$line" >>"$log"
            [[ $line =~ ^\[([0-9]+)/([0-9]+)\] ]] && done=${BASH_REMATCH[1]} all=${BASH_REMATCH[2]}
            line=
        elif [ $status -le 128 ]; then  # the end; more than 128: nothing for two seconds
            [ -z "$line" ] || printf '%s\n' "$line" >>"$log"
            break
        fi
        [ "$all" -ge 20 ] || continue
        text=$(printf 'building: %4d of %d, %3d %%, %d s' "$done" "$all" $((100 * done / all)) $((SECONDS - start)))
        if [ -t 1 ]; then
            printf '\r%s' "$text"
            width=${#text}
        elif [ $((10 * done / all)) -gt "$shown" ] || [ $((SECONDS - last)) -ge 60 ]; then
            echo "$text"
            shown=$((10 * done / all)) last=$SECONDS
        fi
    done
    [ "$width" -eq 0 ] || printf '\r%*s\r' "$width" ''
}

# machine [CPUINFO]: "2 cores, AMD EPYC, AVX-512": cores, family of the processor, best instruction set that the program can use.
machine() {
    local cpuinfo=${1:-/proc/cpuinfo} family flags flag vectors=baseline
    family=$(sed -n 's/^model name[^:]*: *//p' "$cpuinfo" | head -n 1 | sed 's/([A-Za-z]*)//g' | awk '{print $1, $2}')
    flags=" $(sed -n 's/^flags[^:]*: *//p' "$cpuinfo" | head -n 1) "
    has() { for flag; do [[ $flags == *" $flag "* ]] || return 1; done; }
    if has avx512f avx512dq avx512vl; then vectors=AVX-512; elif has avx2 fma; then vectors=AVX2; fi
    echo "$(nproc) cores, ${family:-$(uname -m)}, $vectors"
}

# timed LABEL COMMAND...: runs and says how long it took.
timed() {
    local label=$1 start=$SECONDS status=0
    shift
    "$@" || status=$?
    printf '%-28s %4d s   %s\n' "$label" $((SECONDS - start)) "$([ $status -eq 0 ] && echo done || echo "FAILED ($status)")"
    return $status
}
