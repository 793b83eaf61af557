# Sourced by ./run and ./test: installs what packages.txt lists and is missing (Debian 12, as root or through sudo).
vitrail_setup() {
    local wanted missing=() status
    wanted=$(sed -e 's/#.*//' -e '/^[[:space:]]*$/d' packages.txt)
    status=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' $wanted 2>/dev/null | awk '$2 == "installed" {print $1}') || true # it fails where it knows one not
    for package in $wanted; do
        grep -qxF "$package" <<<"$status" || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    echo "vitrail: installing ${#missing[@]} missing packages: ${missing[*]}" >&2
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        command -v sudo >/dev/null || { echo "vitrail: run this as root, or install sudo, or install: ${missing[*]}" >&2; return 2; }
        as_root=(sudo)
    fi
    "${as_root[@]}" apt-get update -q >&2 &&
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}" >&2 ||
        { echo "vitrail: apt-get could not install: ${missing[*]}" >&2; return 2; }
}

# vitrail_build PRESET TARGET...: configures once, builds what changed.
vitrail_build() {
    local preset=$1
    shift
    export CCACHE_SLOPPINESS=time_macros CCACHE_MAXSIZE=${CCACHE_MAXSIZE:-3G}
    local extra=()
    [ -n "${VITRAIL_WERROR:-}" ] && extra=(-DVITRAIL_WERROR=ON)
    if [ ! -f "build/$preset/build.ninja" ] || [ ${#extra[@]} -gt 0 ]; then
        cmake --preset "$preset" "${extra[@]}" >"build-$preset.log" 2>&1 || { cat "build-$preset.log" >&2; return 2; }
        mkdir -p "build/$preset" && mv "build-$preset.log" "build/$preset/configure.log"
    fi
    cmake --build "build/$preset" --target "$@"
}
